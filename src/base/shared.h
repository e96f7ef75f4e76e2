// Lets C++ and GLSL share headers: the same scalar and vector types, and settings tables.
//
// A settings table is a macro that lists an effect's settings once:
//
//     #define TRACE_SCREEN_SETTINGS(VALUE, SWITCH, CHOICE)  (all in one macro, a line each)
//         VALUE(uint, maxSteps, 64, 1, 4096, "Steps a ray may take before it is a miss.")
//         SWITCH(jitter, 1, "Start each ray at a random part of its first step.")
//         CHOICE(TraceMethod, method, linear, "How rays are traced through the depth buffer.")
//     SETTINGS(TraceScreenSettings, TRACE_SCREEN_SETTINGS)
//
// It generates the GLSL struct, the C++ struct with defaults and (in C++) a SettingInfo for each line, from which the
// command line, JSON files, help and documentation are generated. There names are snake_case: trace_screen.max_steps.
// All members are four bytes, so both languages agree on the layout (scalar block layout).
//
// A choice is a list of names and values:
//
//     #define TRACE_METHODS(OPTION) OPTION(TraceMethod, linear, 0) OPTION(TraceMethod, hiz, 1)
//     CHOICES(TraceMethod, TRACE_METHODS)
//
// In C++ it becomes `enum class TraceMethod`; both languages get the constants TraceMethod_linear and TraceMethod_hiz,
// for functions that both compile.
#ifndef REFLET_BASE_SHARED_H
#define REFLET_BASE_SHARED_H

#ifdef __cplusplus

#include "base/math.h"
#include "base/setting_info.h"

#include <cstddef>

namespace reflet {
using uint = uint32_t;
}  // namespace reflet

#define SHARED_BEGIN namespace reflet {
#define SHARED_END }

#define SHARED_OPTION_ENUM(type, name, value) name = value,
#define SHARED_OPTION_NAME(type, name, value) {#name, value},
#define SHARED_OPTION_CONSTANT(type, name, value) constexpr uint type##_##name = value;
#define CHOICES(type, OPTIONS)                                      \
    enum class type : uint32_t { OPTIONS(SHARED_OPTION_ENUM) };     \
    OPTIONS(SHARED_OPTION_CONSTANT)                                 \
    inline std::vector<SettingOption> settingOptions(const type*) { \
        return {OPTIONS(SHARED_OPTION_NAME)};                       \
    }

#define SHARED_VALUE_MEMBER(type, name, standard, lowest, highest, help) type name = standard;
#define SHARED_SWITCH_MEMBER(name, standard, help) uint name = standard;
#define SHARED_CHOICE_MEMBER(type, name, standard, help) type name = type::standard;
#define SHARED_VALUE_INFO(type, name, standard, lowest, highest, help) \
    valueInfo(#name, offsetof(Self, name), type(standard), type(lowest), type(highest), help),
#define SHARED_SWITCH_INFO(name, standard, help) switchInfo(#name, offsetof(Self, name), standard, help),
#define SHARED_CHOICE_INFO(type, name, standard, help)                             \
    choiceInfo(#name, offsetof(Self, name), static_cast<uint32_t>(type::standard), \
               settingOptions(static_cast<const type*>(nullptr)), help),
#define SETTINGS(structName, TABLE)                                                \
    struct structName {                                                            \
        TABLE(SHARED_VALUE_MEMBER, SHARED_SWITCH_MEMBER, SHARED_CHOICE_MEMBER)     \
    };                                                                             \
    inline std::vector<SettingInfo> settingInfos(const structName*) {              \
        using Self = structName;                                                   \
        return {TABLE(SHARED_VALUE_INFO, SHARED_SWITCH_INFO, SHARED_CHOICE_INFO)}; \
    }

#else  // GLSL

// A reserved word in GLSL that is also a setting's name: shaders see another word instead.
#define filter filterKind

#define SHARED_BEGIN
#define SHARED_END

#define SHARED_OPTION_CONSTANT(type, name, value) const uint type##_##name = value;
#define CHOICES(type, OPTIONS) OPTIONS(SHARED_OPTION_CONSTANT)

#define SHARED_VALUE_MEMBER(type, name, standard, lowest, highest, help) type name;
#define SHARED_SWITCH_MEMBER(name, standard, help) uint name;
#define SHARED_CHOICE_MEMBER(type, name, standard, help) uint name;
#define SETTINGS(structName, TABLE)                                            \
    struct structName {                                                        \
        TABLE(SHARED_VALUE_MEMBER, SHARED_SWITCH_MEMBER, SHARED_CHOICE_MEMBER) \
    };

#endif

#endif
