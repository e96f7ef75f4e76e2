// The functions of the driver without a device, by name.
#pragma once

#ifndef VK_NO_PROTOTYPES
#define VK_NO_PROTOTYPES
#endif
#include <vulkan/vulkan_core.h>

#include <string_view>
#include <unordered_map>

namespace reflet::stub {

using Functions = std::unordered_map<std::string_view, PFN_vkVoidFunction>;

template <class Pfn>
void addFunction(Functions& to, const char* name, Pfn function) {
    to[name] = reinterpret_cast<PFN_vkVoidFunction>(function);
}

/// That does nothing.
template <class Pfn>
struct Nothing;
template <class... Args>
struct Nothing<void(VKAPI_PTR*)(Args...)> {
    static VKAPI_ATTR void VKAPI_CALL call(Args... /*arguments*/) {}
};

// With the type that Vulkan gives a function of this name.
#define REFLET_STUB(name, function) addFunction<PFN_##name>(to, #name, function);
#define REFLET_STUB_NOTHING(name) addFunction<PFN_##name>(to, #name, Nothing<PFN_##name>::call);

void addObjectFunctions(Functions& to);
void addMemoryFunctions(Functions& to);
void addCommandFunctions(Functions& to);

}  // namespace reflet::stub
