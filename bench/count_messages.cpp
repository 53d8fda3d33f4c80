// Counts what every rank of an MPI program sends: mpicxx -shared -fPIC -O2 -o libcount.so count_messages.cpp, then
// COUNT_MESSAGES=PREFIX LD_PRELOAD=libcount.so on every rank. Each rank writes PREFIX.RANK at its end. The counts are cut
// where all ranks meet in MPI_Barrier, as LAMMPS does before and after the loop over time steps: lines are
//   SEGMENT send TAG MESSAGES BYTES, SEGMENT to RANK MESSAGES, SEGMENT CALL CALLS BYTES
// of collective calls the bytes that this rank gives, with one entry for every rank where the call takes one.

#include <mpi.h>

#include <cstdio>
#include <cstdlib>
#include <map>
#include <string>

namespace {

struct Count {
  long calls = 0, bytes = 0;
  void add(long more)
  {
    calls++;
    bytes += more;
  }
};

struct Segment {
  std::map<int, Count> by_tag;
  std::map<int, long> to;
  std::map<std::string, Count> collectives;
};

std::map<int, Segment> segments;
int now = 0;

long size_of(int count, MPI_Datatype type)
{
  int size;
  PMPI_Type_size(type, &size);
  return static_cast<long>(size) * count;
}

void sent(int count, MPI_Datatype type, int to, int tag)
{
  if (to == MPI_PROC_NULL) return;
  segments[now].by_tag[tag].add(size_of(count, type));
  segments[now].to[to]++;
}

void collective(const char *name, long bytes)
{
  segments[now].collectives[name].add(bytes);
}

int ranks(MPI_Comm comm)
{
  int n;
  PMPI_Comm_size(comm, &n);
  return n;
}

}    // namespace

extern "C" {

// NOLINTBEGIN: MPI's own names
int MPI_Send(const void *buf, int n, MPI_Datatype type, int to, int tag, MPI_Comm comm)
{
  sent(n, type, to, tag);
  return PMPI_Send(buf, n, type, to, tag, comm);
}
int MPI_Isend(const void *buf, int n, MPI_Datatype type, int to, int tag, MPI_Comm comm, MPI_Request *request)
{
  sent(n, type, to, tag);
  return PMPI_Isend(buf, n, type, to, tag, comm, request);
}
int MPI_Rsend(const void *buf, int n, MPI_Datatype type, int to, int tag, MPI_Comm comm)
{
  sent(n, type, to, tag);
  return PMPI_Rsend(buf, n, type, to, tag, comm);
}
int MPI_Ssend(const void *buf, int n, MPI_Datatype type, int to, int tag, MPI_Comm comm)
{
  sent(n, type, to, tag);
  return PMPI_Ssend(buf, n, type, to, tag, comm);
}
int MPI_Sendrecv(const void *buf, int n, MPI_Datatype type, int to, int tag, void *in, int n_in,
                 MPI_Datatype type_in, int from, int tag_in, MPI_Comm comm, MPI_Status *status)
{
  sent(n, type, to, tag);
  return PMPI_Sendrecv(buf, n, type, to, tag, in, n_in, type_in, from, tag_in, comm, status);
}

int MPI_Barrier(MPI_Comm comm)
{
  now++;
  return PMPI_Barrier(comm);
}
int MPI_Bcast(void *buf, int n, MPI_Datatype type, int root, MPI_Comm comm)
{
  collective("Bcast", size_of(n, type));
  return PMPI_Bcast(buf, n, type, root, comm);
}
int MPI_Allreduce(const void *buf, void *out, int n, MPI_Datatype type, MPI_Op op, MPI_Comm comm)
{
  collective("Allreduce", size_of(n, type));
  return PMPI_Allreduce(buf, out, n, type, op, comm);
}
int MPI_Reduce(const void *buf, void *out, int n, MPI_Datatype type, MPI_Op op, int root, MPI_Comm comm)
{
  collective("Reduce", size_of(n, type));
  return PMPI_Reduce(buf, out, n, type, op, root, comm);
}
int MPI_Scan(const void *buf, void *out, int n, MPI_Datatype type, MPI_Op op, MPI_Comm comm)
{
  collective("Scan", size_of(n, type));
  return PMPI_Scan(buf, out, n, type, op, comm);
}
int MPI_Exscan(const void *buf, void *out, int n, MPI_Datatype type, MPI_Op op, MPI_Comm comm)
{
  collective("Exscan", size_of(n, type));
  return PMPI_Exscan(buf, out, n, type, op, comm);
}
int MPI_Reduce_scatter(const void *buf, void *out, const int *n, MPI_Datatype type, MPI_Op op, MPI_Comm comm)
{
  int all = 0;
  for (int k = 0; k < ranks(comm); k++) all += n[k];
  collective("Reduce_scatter", size_of(all, type));
  return PMPI_Reduce_scatter(buf, out, n, type, op, comm);
}
int MPI_Allgather(const void *buf, int n, MPI_Datatype type, void *out, int n_out, MPI_Datatype type_out,
                  MPI_Comm comm)
{
  collective("Allgather", ranks(comm) * size_of(n_out, type_out));
  return PMPI_Allgather(buf, n, type, out, n_out, type_out, comm);
}
int MPI_Allgatherv(const void *buf, int n, MPI_Datatype type, void *out, const int *n_out, const int *at,
                   MPI_Datatype type_out, MPI_Comm comm)
{
  long all = 0;
  for (int k = 0; k < ranks(comm); k++) all += size_of(n_out[k], type_out);
  collective("Allgatherv", all);
  return PMPI_Allgatherv(buf, n, type, out, n_out, at, type_out, comm);
}
int MPI_Gather(const void *buf, int n, MPI_Datatype type, void *out, int n_out, MPI_Datatype type_out, int root,
               MPI_Comm comm)
{
  collective("Gather", ranks(comm) * size_of(n, type));
  return PMPI_Gather(buf, n, type, out, n_out, type_out, root, comm);
}
int MPI_Alltoall(const void *buf, int n, MPI_Datatype type, void *out, int n_out, MPI_Datatype type_out,
                 MPI_Comm comm)
{
  collective("Alltoall", ranks(comm) * size_of(n, type));
  return PMPI_Alltoall(buf, n, type, out, n_out, type_out, comm);
}
int MPI_Alltoallv(const void *buf, const int *n, const int *at, MPI_Datatype type, void *out, const int *n_out,
                  const int *at_out, MPI_Datatype type_out, MPI_Comm comm)
{
  long all = 0;
  for (int k = 0; k < ranks(comm); k++) all += size_of(n[k], type);
  collective("Alltoallv", all + 4 * ranks(comm));
  return PMPI_Alltoallv(buf, n, at, type, out, n_out, at_out, type_out, comm);
}

int MPI_Finalize()
{
  int me;
  PMPI_Comm_rank(MPI_COMM_WORLD, &me);
  const char *prefix = std::getenv("COUNT_MESSAGES");
  FILE *file = std::fopen((std::string(prefix ? prefix : "messages") + "." + std::to_string(me)).c_str(), "w");
  if (file) {
    for (const auto &[segment, counts] : segments) {
      for (const auto &[tag, c] : counts.by_tag)
        std::fprintf(file, "%d send %d %ld %ld\n", segment, tag, c.calls, c.bytes);
      for (const auto &[rank, n] : counts.to) std::fprintf(file, "%d to %d %ld\n", segment, rank, n);
      for (const auto &[name, c] : counts.collectives)
        std::fprintf(file, "%d %s %ld %ld\n", segment, name.c_str(), c.calls, c.bytes);
    }
    std::fprintf(file, "%d end\n", now);
    std::fclose(file);
  }
  return PMPI_Finalize();
}
// NOLINTEND
}
