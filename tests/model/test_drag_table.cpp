// The tabulated drag: within its bound of the law itself, everywhere.

#include "model_testing.h"

#include "model/drag_table.h"

using namespace ClusterDEM;

TEST(DragTable, WithinItsBoundOfEveryLaw)
{
  RandomInputs random(71);
  const double parameters[] = {0.8, 1.1};
  for (const DragLawEntry &entry : drag_laws()) {
    const auto law = entry.make(parameters);
    const DragTable table(entry.make(parameters));
    for (int k = 0; k < 200000; k++) {
      const double re = random.log_uniform(1.0e-8, 1.0e8), exact = law->cd_re(re);
      ASSERT_LE(std::fabs(table.cd_re(re) - exact), DragTable::RELATIVE_ERROR * exact) << entry.name << " " << re;
    }
    for (double re : {0.0, 1.0e-300, 1.0 / 1024, 1.0, 1000.0, 65536.0, 1.0e300})    // edges, out of range
      ASSERT_LE(std::fabs(table.cd_re(re) - law->cd_re(re)), DragTable::RELATIVE_ERROR * law->cd_re(re))
          << entry.name << " " << re;
  }
}

TEST(DragTable, TheKinkOfALawIsLeftToTheLaw)
{
  // Schiller & Naumann meet C_D = 0.44 near Re = 988; no cubic follows a kink
  const SchillerNaumannDrag law;
  const DragTable table(std::make_unique<SchillerNaumannDrag>());
  for (double re = 980.0; re < 996.0; re += 1.0e-3)
    ASSERT_LE(std::fabs(table.cd_re(re) - law.cd_re(re)), DragTable::RELATIVE_ERROR * law.cd_re(re)) << re;
}
