// Settings written to JSON and read back.
#include "base/json_text.h"
#include "pass/harness.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace reflet::test::settings_json_test {
namespace {

TEST(SettingsJson, HasOnlyWhatDiffersAndMakesTheSameSettings) {
    EXPECT_EQ(jsonText(settingsJson(Settings{}, Settings{})), "{}");
    const Settings some = settingsOf({"diffuse.rays=8", "trace_screen.method=dda", "trace_screen.thickness=0.123",
                                      "temporal.enabled=true", "tonemap.exposure=-1.5"});
    const nlohmann::ordered_json json = settingsJson(some, Settings{});
    EXPECT_EQ(json.size(), 4U);
    EXPECT_EQ(json["trace_screen"]["method"], "dda");
    EXPECT_EQ(json["temporal"]["enabled"], true);
    Settings read;
    applySettingsJson(read, parseJson(jsonText(json)), "here");
    EXPECT_TRUE(sameSettings(read, some));
}

TEST(SettingsJson, KeepsEverySettingAtItsEnds) {
    for (const SettingEntry& entry : settingEntries()) {
        for (const double end : {entry.info.lowest, entry.info.highest}) {
            Settings changed;
            if (entry.info.type == SettingType::choice) {
                setSetting(changed, entry.name, entry.info.options[static_cast<size_t>(end)].name);
            } else if (entry.info.type == SettingType::toggle) {
                setSetting(changed, entry.name, end > 0.0 ? "true" : "false");
            } else {
                setSetting(changed, entry.name, fmt::format("{}", static_cast<float>(end)));
            }
            Settings read;
            applySettingsJson(read, parseJson(jsonText(settingsJson(changed, Settings{}))), entry.name);
            EXPECT_TRUE(sameSettings(read, changed)) << entry.name;
        }
    }
}

}  // namespace
}  // namespace reflet::test::settings_json_test
