/* ----------------------------------------------------------------------
   Cluster DEM for LAMMPS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

// The command `fork_server SECONDS MEGABYTES`: tries many continuations of one input. Each is run by a
// child process, so that it starts from the same state, whatever the others did, and may crash; a fork
// costs milliseconds where a start of the engine costs tenths of a second.
//
// Standard input: a line with a number of bytes, then as many bytes of commands; again and again.
// Answer on standard output: a line with the status and a number of bytes, then as many bytes: all that
// the child printed. Status: 0 ran to its end, 1 LAMMPS refused, 2 another exception, 3 ended with a
// number that is not finite, negative: killed by that signal (SIGALRM after SECONDS).

#include "lammpsplugin.h"

#include "atom.h"
#include "command.h"
#include "error.h"
#include "exceptions.h"
#include "input.h"
#include "version.h"

#include <cmath>
#include <cstdio>
#include <sstream>
#include <string>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>
#include <vector>

using namespace LAMMPS_NS;

namespace {

enum Status { FINE, REFUSED, EXCEPTION, NOT_FINITE };

class ForkServer : public Command {
 public:
  using Command::Command;

  void command(int narg, char **arg) override
  {
    if (narg != 2) error->all(FLERR, "Illegal fork_server command: SECONDS MEGABYTES");
    const int seconds = std::stoi(arg[0]);
    const rlim_t megabytes = std::stoul(arg[1]);
    const int said = fileno(std::tmpfile());
    std::puts("fork_server ready");
    std::fflush(stdout);
    std::size_t size;
    while (std::scanf("%zu", &size) == 1 && std::getchar() == '\n') {
      std::string script(size, ' ');
      if (std::fread(script.data(), 1, size, stdin) != size) break;
      if (ftruncate(said, 0) != 0 || lseek(said, 0, SEEK_SET) != 0) break;
      const pid_t child = fork();
      if (child == 0) try_out(script, said, seconds, megabytes);
      int state = 0;
      waitpid(child, &state, 0);
      answer(WIFSIGNALED(state) ? -WTERMSIG(state) : WEXITSTATUS(state), said);
    }
    _exit(0);    // nothing of this run is worth a clean end
  }

 private:
  [[noreturn]] void try_out(const std::string &script, int said, int seconds, rlim_t megabytes)
  {
    dup2(said, STDOUT_FILENO);
    dup2(said, STDERR_FILENO);
    if (megabytes) {
      const rlimit limit{megabytes << 20, megabytes << 20};
      setrlimit(RLIMIT_AS, &limit);
    }
    alarm(seconds);
    Status status = FINE;
    try {
      std::istringstream lines(script);
      for (std::string line; std::getline(lines, line);) input->one(line);
      if (!finite()) status = NOT_FINITE;
    } catch (LAMMPSException &) {
      status = REFUSED;
    } catch (std::exception &e) {
      std::printf("exception: %s\n", e.what());
      status = EXCEPTION;
    }
    std::fflush(nullptr);
    _exit(status);
  }

  bool finite() const
  {
    for (int i = 0; i < atom->nlocal; i++)
      for (const double *vector : {atom->x[i], atom->v[i], atom->f[i]})
        for (int k = 0; k < 3; k++)
          if (!std::isfinite(vector[k])) return false;
    return true;
  }

  static void answer(int status, int said)
  {
    std::vector<char> text(lseek(said, 0, SEEK_END));
    const ssize_t size = pread(said, text.data(), text.size(), 0);
    std::printf("%d %zd\n", status, size);
    std::fwrite(text.data(), 1, size, stdout);
    std::fflush(stdout);
  }
};

void *create(void *lmp)
{
  return new ForkServer((LAMMPS *) lmp);
}

}    // namespace

extern "C" void lammpsplugin_init(void *lmp, void *handle, void *regfunc)
{
  lammpsplugin_t plugin;
  plugin.version = LAMMPS_VERSION;
  plugin.style = "command";
  plugin.name = "fork_server";
  plugin.info = "runs many continuations of one input";
  plugin.author = "Cluster DEM developers";
  plugin.creator.v1 = (lammpsplugin_factory1 *) &create;
  plugin.handle = handle;
  ((lammpsplugin_regfunc) regfunc)(&plugin, lmp);
}
