// A job array on a real Slurm with two nodes, one of which dies. Skipped where Slurm is not installed.
#include "cli/program.h"

#include <filesystem>

namespace reflet::slurm_test {
namespace {

class Slurm : public ProgramTest {};

// About 25 s: Slurm takes 15 s to declare a node dead, and 5 s before it starts a requeued task. It mostly waits.
TEST_F(Slurm, AnArrayIsWholeAndEqualToOneProcessWhenANodeDies) {
    for (const char* program : {"slurmctld", "slurmd", "sbatch", "munged"}) {
        if (!isInstalled(program) && !std::filesystem::exists(std::filesystem::path("/usr/sbin") / program)) {
            GTEST_SKIP() << program << " is not installed";
        }
    }
    const Outcome done = runOther("bash", {REFLET_SOURCE "/tests/slurm/node_dies.sh", REFLET_PROGRAM, "."});
    EXPECT_EQ(done.status, 0) << done.out << done.err;
    EXPECT_NE(done.out.find("240 frames, equal to those of one process"), std::string::npos) << done.out;
}

}  // namespace
}  // namespace reflet::slurm_test
