// The fuzz targets that read settings, records of sequences and the window's state. They need no device.
#include "fuzz/replay.h"

#include <cstdlib>
#include <optional>

namespace reflet::test::fuzz_replay_test {
namespace {

/// Which the target of saved states sets.
class KeepsConfigurationFolder {
public:
    KeepsConfigurationFolder() {
        if (const char* value = std::getenv(name)) {
            before_ = value;
        }
    }
    ~KeepsConfigurationFolder() {
        if (before_) {
            ::setenv(name, before_->c_str(), 1);
        } else {
            ::unsetenv(name);
        }
    }
    KeepsConfigurationFolder(const KeepsConfigurationFolder&) = delete;
    KeepsConfigurationFolder& operator=(const KeepsConfigurationFolder&) = delete;
    KeepsConfigurationFolder(KeepsConfigurationFolder&&) = delete;
    KeepsConfigurationFolder& operator=(KeepsConfigurationFolder&&) = delete;

private:
    static constexpr const char* name = "XDG_CONFIG_HOME";
    std::optional<std::string> before_;
};

TEST(FuzzTargets, ThatReadSettingsRecordsAndStatesSurviveTheirSeedsAndDamagedOnes) {
    const KeepsConfigurationFolder keeps;
    fuzz::replay(
        {{"settings", fuzz::settings}, {"sequence_record", fuzz::sequenceRecord}, {"saved_state", fuzz::savedState}},
        fuzz::stateSeeds(), 100);
}

}  // namespace
}  // namespace reflet::test::fuzz_replay_test
