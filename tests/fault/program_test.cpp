// The program with a Vulkan call that fails. REFLET_FAULT_ALL: with many (tests/fault/all.sh).
#include "cli/desktop.h"
#include "fault/sweep.h"

namespace reflet::fault {
namespace {

class Faulty : public ProgramTest {
protected:
    [[nodiscard]] Command command(const Arguments& arguments, std::vector<std::string> outputs) const {
        return {arguments.front(), [this, arguments](const Environment& with) { return run(arguments, with); },
                path("x").parent_path(), std::move(outputs)};
    }
};

// Over 5 s: some thirty processes. So that they take no longer, without most effects.
TEST_F(Faulty, RenderSaysWhatFailedAndLeavesNothing) {
    sweep(command({"render", "builtin:cubes", "--preset", "plain", "--size", "32x18", "-o", "a.png", "-o", "a.exr"},
                  {"a.png", "a.exr"}),
          1000);
}

}  // namespace
}  // namespace reflet::fault
