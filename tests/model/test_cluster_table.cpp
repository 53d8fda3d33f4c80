// Columns per cluster: what goes with a cluster, what is kept in restart files, what lists cost.

#include "model_testing.h"

#include "cluster_table.h"

using LAMMPS_NS::ClusterTable;

namespace {

struct Three {    // more than one number of a message
  double a = 1.5;
  int b = 2;
  double c = 3.5;
};

}    // namespace

TEST(ClusterTable, AClusterThatMigratesTakesItsCarriedColumnsAlong)
{
  ClusterTable table, elsewhere;
  auto fill = [](ClusterTable &t) {
    return std::tie(t.add<int>(ClusterTable::SCRATCH), t.add<int>(ClusterTable::CARRIED),
                    t.add<Three>(ClusterTable::KEPT), t.add_lists<int>(ClusterTable::KEPT), t.add_shown(2));
  };
  auto [scratch, count, three, list, shown] = fill(table);
  auto [scratch2, count2, three2, list2, shown2] = fill(elsewhere);
  table.grow(3);
  elsewhere.grow(2);
  scratch[1] = 7;
  count[1] = 400;
  three[1] = {-1.0, -2, -3.0};
  list[1] = {5, 6, 9};
  shown[1][0] = 0.25;
  shown[1][1] = 0.75;
  scratch2[0] = 11;

  EXPECT_EQ(table.size(1, ClusterTable::CARRIED), 1 + 3 + (1 + 3) + 2);
  EXPECT_EQ(table.size(0, ClusterTable::CARRIED), 1 + 3 + 1 + 2);
  EXPECT_EQ(table.size(1, ClusterTable::KEPT), 3 + (1 + 3));
  std::vector<double> message(table.size(1, ClusterTable::CARRIED));
  EXPECT_EQ(table.pack(1, message.data(), ClusterTable::CARRIED), 10);
  EXPECT_EQ(elsewhere.unpack(0, message.data(), ClusterTable::CARRIED), 10);
  EXPECT_EQ(scratch2[0], 11);    // whoever uses it fills it
  EXPECT_EQ(count2[0], 400);
  EXPECT_EQ(three2[0].a, -1.0);
  EXPECT_EQ(three2[0].b, -2);
  EXPECT_EQ(three2[0].c, -3.0);
  EXPECT_EQ(list2[0], (std::vector<int>{5, 6, 9}));
  EXPECT_EQ(shown2[0][0], 0.25);
  EXPECT_EQ(shown2[0][1], 0.75);
  EXPECT_EQ(elsewhere.size(0, ClusterTable::KEPT), 7);
}

TEST(ClusterTable, RestartFilesHoldWhatIsKept)
{
  ClusterTable table;
  auto &count = table.add<int>(ClusterTable::CARRIED);
  EXPECT_FALSE(table.keeps_any());
  auto &kept = table.add<int>(ClusterTable::KEPT);
  EXPECT_TRUE(table.keeps_any());
  EXPECT_FALSE(table.has_lists());
  table.add_lists<int>(ClusterTable::CARRIED);
  EXPECT_TRUE(table.has_lists());
  table.grow(2);
  count[0] = 1;
  kept[0] = 2;
  double file[1];
  EXPECT_EQ(table.pack(0, file, ClusterTable::KEPT), 1);
  EXPECT_EQ(table.unpack(1, file, ClusterTable::KEPT), 1);
  EXPECT_EQ(kept[1], 2);
  EXPECT_EQ(count[1], 0);
}

TEST(ClusterTable, CopiesAndClears)
{
  ClusterTable table;
  auto &scratch = table.add<int>(ClusterTable::SCRATCH);
  auto &three = table.add<Three>(ClusterTable::CARRIED);
  auto &list = table.add_lists<int>(ClusterTable::KEPT);
  auto &shown = table.add_shown(1);
  table.grow(2);
  scratch[0] = 3;
  three[0] = {9.0, 8, 7.0};
  list[0] = {4};
  shown[0][0] = 0.5;
  table.copy(0, 1);
  EXPECT_EQ(scratch[1], 0);
  EXPECT_EQ(three[1].b, 8);
  EXPECT_EQ(list[1], std::vector<int>{4});
  EXPECT_EQ(shown[1][0], 0.5);
  table.grow(50);    // values stay, rows of the engine's array point to where they are now
  EXPECT_EQ(shown.array()[1], shown[1]);
  EXPECT_EQ(shown[1][0], 0.5);
  table.clear(1);
  EXPECT_EQ(three[1].a, 1.5);    // as a new one
  EXPECT_TRUE(list[1].empty());
  EXPECT_EQ(shown[1][0], 0.0);
  EXPECT_EQ(three[0].a, 9.0);
}
