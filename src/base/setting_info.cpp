// Describes one line of a settings table as data.
#include "base/setting_info.h"

#include "base/text.h"

#include <utility>

namespace reflet {

SettingInfo valueInfo(const char* name, size_t offset, float standard, float lowest, float highest, const char* help) {
    return {snakeCase(name), SettingType::real, offset, standard, lowest, highest, {}, help};
}

SettingInfo valueInfo(const char* name, size_t offset, uint32_t standard, uint32_t lowest, uint32_t highest,
                      const char* help) {
    return {snakeCase(name),
            SettingType::integer,
            offset,
            static_cast<double>(standard),
            static_cast<double>(lowest),
            static_cast<double>(highest),
            {},
            help};
}

SettingInfo switchInfo(const char* name, size_t offset, uint32_t standard, const char* help) {
    return {snakeCase(name), SettingType::toggle, offset, static_cast<double>(standard), 0.0, 1.0, {}, help};
}

SettingInfo choiceInfo(const char* name, size_t offset, uint32_t standard, std::vector<SettingOption> options,
                       const char* help) {
    for (SettingOption& option : options) {
        option.name = snakeCase(option.name);
    }
    const double highest = static_cast<double>(options.size()) - 1.0;
    return {snakeCase(name), SettingType::choice, offset, static_cast<double>(standard), 0.0,
            highest,         std::move(options),  help};
}

}  // namespace reflet
