// One line of a settings table as data: the command line, JSON, help and documentation are generated from it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace reflet {

enum class SettingType : uint8_t { real, integer, toggle, choice };

struct SettingOption {
    std::string name;  ///< snake_case
    uint32_t value = 0;
};

struct SettingInfo {
    std::string name;  ///< snake_case: "max_steps"
    SettingType type = SettingType::real;
    size_t offset = 0;  ///< bytes to the four that hold the value (float, or uint32_t for all other types)
    double standard = 0.0;
    double lowest = 0.0;
    double highest = 0.0;
    std::vector<SettingOption> options;  ///< for a choice
    std::string help;
};

// Called by the macros of base/shared.h. `name` is that of the C++ member; it becomes snake_case.
SettingInfo valueInfo(const char* name, size_t offset, float standard, float lowest, float highest, const char* help);
SettingInfo valueInfo(const char* name, size_t offset, uint32_t standard, uint32_t lowest, uint32_t highest,
                      const char* help);
SettingInfo switchInfo(const char* name, size_t offset, uint32_t standard, const char* help);
SettingInfo choiceInfo(const char* name, size_t offset, uint32_t standard, std::vector<SettingOption> options,
                       const char* help);

}  // namespace reflet
