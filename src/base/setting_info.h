// One line of a settings table as data: what the command line, JSON, help and documentation are made of.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace reflet {

enum class SettingType : uint8_t { real, integer, toggle, choice };

struct SettingOption {
    std::string name;
    uint32_t value = 0;
};

struct SettingInfo {
    std::string name;
    SettingType type = SettingType::real;
    size_t offset = 0;  ///< bytes, of the four that hold the value (float, or uint32_t for all other types)
    double standard = 0.0;
    double lowest = 0.0;
    double highest = 0.0;
    std::vector<SettingOption> options;  ///< of a choice
    std::string help;
};

inline SettingInfo valueInfo(const char* name, size_t offset, float standard, float lowest, float highest,
                             const char* help) {
    return {name, SettingType::real, offset, standard, lowest, highest, {}, help};
}

inline SettingInfo valueInfo(const char* name, size_t offset, uint32_t standard, uint32_t lowest, uint32_t highest,
                             const char* help) {
    return {name,
            SettingType::integer,
            offset,
            static_cast<double>(standard),
            static_cast<double>(lowest),
            static_cast<double>(highest),
            {},
            help};
}

inline SettingInfo switchInfo(const char* name, size_t offset, uint32_t standard, const char* help) {
    return {name, SettingType::toggle, offset, static_cast<double>(standard), 0.0, 1.0, {}, help};
}

inline SettingInfo choiceInfo(const char* name, size_t offset, uint32_t standard, std::vector<SettingOption> options,
                              const char* help) {
    const double highest = static_cast<double>(options.size()) - 1.0;
    return {name, SettingType::choice, offset, static_cast<double>(standard), 0.0, highest, std::move(options), help};
}

}  // namespace reflet
