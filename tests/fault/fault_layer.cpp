// A Vulkan layer that makes one call fail, without calling down, and reports objects that were never destroyed. See
// faults.h for the environment variables, and the exported functions at the end for tests that have it in their
// process.
#include "fault/faults.h"

#include <vulkan/vk_layer.h>

#include <algorithm>
#include <cstring>
#include <string_view>
#include <unordered_map>
#include <utility>

namespace reflet::fault {

namespace {

/// What is below the layer for an instance or a device. Looked up when that is made: later the loader's own look-up
/// returns functions of the layers above.
struct Chain {
    VkInstance instance = VK_NULL_HANDLE;
    VkDevice device = VK_NULL_HANDLE;  ///< none of an instance
    PFN_vkGetInstanceProcAddr lookUpInstance = nullptr;
    PFN_vkGetDeviceProcAddr lookUpDevice = nullptr;
    std::unordered_map<std::string_view, PFN_vkVoidFunction> functions;

    [[nodiscard]] PFN_vkVoidFunction find(const char* name) const {
        const auto found = functions.find(name);
        return found == functions.end() ? nullptr : found->second;
    }
};

std::mutex chainMutex;

std::unordered_map<const void*, Chain>& chains() {
    static auto* all = new std::unordered_map<const void*, Chain>;
    return *all;
}

// The loader's dispatch table, which all dispatchable handles of an instance or of a device begin with.
template <class Handle>
const void* keyOf(Handle handle) {
    return *reinterpret_cast<const void* const*>(handle);
}

// Elements of the map stay where they are.
const Chain& chainOf(const void* key) {
    const std::scoped_lock lock(chainMutex);
    return chains().at(key);
}

template <class Handle>
void addChain(Handle handle, Chain chain, PFN_vkVoidFunction(VKAPI_PTR* lookUp)(Handle, const char*)) {
    const auto add = [&](const char* name) { chain.functions.emplace(name, lookUp(handle, name)); };
#define REFLET_ADD(name, ...) add(#name);
#define REFLET_ADD_BOTH(name, destroying, ...) add(#name), add(#destroying);
    REFLET_CREATING(REFLET_ADD_BOTH)
    REFLET_OTHER(REFLET_ADD)
#undef REFLET_ADD
#undef REFLET_ADD_BOTH
    add("vkDestroyInstance");
    add("vkDestroyDevice");
    add("vkCreateDevice");
    const std::scoped_lock lock(chainMutex);
    chains()[keyOf(handle)] = std::move(chain);
}

// A device that is lost executes nothing any more, and what it used may be destroyed. The real one has to end its work.
void endWork(const Chain& chain) {
    if (chain.device != VK_NULL_HANDLE) {
        reinterpret_cast<PFN_vkDeviceWaitIdle>(chain.find("vkDeviceWaitIdle"))(chain.device);
    }
}

template <class Object>
uint64_t bits(Object object) {
    return reinterpret_cast<uint64_t>(object);
}

// Outputs of a failed call are undefined by the specification: whoever uses them finds this.
template <class Object>
void spoil(Object* object) {
    *object = reinterpret_cast<Object>(uint64_t{0xDEADDEADDEAD0000});
}

// ---- the surface that a call concerns ------------------------------------------------------------------------------

template <class T>
uint64_t surfaceIn(const T& /*argument*/) {
    return 0;
}
uint64_t surfaceIn(const VkSurfaceKHR& surface) {
    return bits(surface);
}
uint64_t surfaceIn(const VkSwapchainKHR& swapchain) {
    return Faults::get().surfaceOf(bits(swapchain));
}
uint64_t surfaceIn(const VkPresentInfoKHR* const& info) {
    return surfaceIn(info->pSwapchains[0]);
}
uint64_t surfaceIn(const VkSwapchainCreateInfoKHR* const& info) {
    return surfaceIn(info->surface);
}

// ---- outputs of calls: noted if the call succeeded, spoiled if it did not -------------------------------------------

template <class... Args>
void finish(Function /*function*/, const void* /*key*/, bool /*succeeded*/, const Args&... /*arguments*/) {}

template <class Info, class Object>
void finish(Function function, const void* key, bool succeeded, const Info* const& /*info*/,
            const VkAllocationCallbacks* const& /*host*/, Object* const& object) {
    if (succeeded) {
        Faults::get().made(function, key, bits(*object));
    } else {
        spoil(object);
    }
}

void finish(Function function, const void* key, bool succeeded, const VkSwapchainCreateInfoKHR* const& info,
            const VkAllocationCallbacks* const& /*host*/, VkSwapchainKHR* const& object) {
    if (succeeded) {
        Faults::get().made(function, key, bits(*object));
        Faults::get().bind(bits(*object), bits(info->surface));
    } else {
        spoil(object);
    }
}

template <class Info>
void finish(Function function, const void* key, bool succeeded, const VkPipelineCache& /*cache*/, const uint32_t& count,
            const Info* const& /*infos*/, const VkAllocationCallbacks* const& /*host*/, VkPipeline* const& pipelines) {
    for (uint32_t i = 0; i < count; ++i) {
        if (succeeded) {
            Faults::get().made(function, key, bits(pipelines[i]));
        } else {
            pipelines[i] = VK_NULL_HANDLE;  // by the specification
        }
    }
}

void finish(Function /*function*/, const void* /*key*/, bool succeeded, const VkDescriptorSetAllocateInfo* const& info,
            VkDescriptorSet* const& sets) {
    std::fill_n(sets, succeeded ? 0 : info->descriptorSetCount, VkDescriptorSet{});  // by the specification
}

void finish(Function /*function*/, const void* /*key*/, bool succeeded, const VkCommandBufferAllocateInfo* const& info,
            VkCommandBuffer* const& commands) {
    std::fill_n(commands, succeeded ? 0 : info->commandBufferCount, VkCommandBuffer{});
}

void finish(Function /*function*/, const void* /*key*/, bool succeeded, const VkDeviceMemory& /*memory*/,
            const VkDeviceSize& /*offset*/, const VkDeviceSize& /*size*/, const VkMemoryMapFlags& /*flags*/,
            void** const& mapped) {
    if (!succeeded) {
        spoil(mapped);
    }
}

// Counts and lists.
template <class T>
void finishList(bool succeeded, uint32_t* count, T* list) {
    if (!succeeded && list == nullptr) {
        *count = 7;
    }
}
void finish(Function /*function*/, const void* /*key*/, bool succeeded, uint32_t* const& count,
            VkPhysicalDevice* const& list) {
    finishList(succeeded, count, list);
}
void finish(Function /*function*/, const void* /*key*/, bool succeeded, const char* const& /*layer*/,
            uint32_t* const& count, VkExtensionProperties* const& list) {
    finishList(succeeded, count, list);
}
template <class T>
void finish(Function /*function*/, const void* /*key*/, bool succeeded, const VkSurfaceKHR& /*surface*/,
            uint32_t* const& count, T* const& list) {
    finishList(succeeded, count, list);
}
void finish(Function /*function*/, const void* /*key*/, bool succeeded, const VkSwapchainKHR& /*swapchain*/,
            uint32_t* const& count, VkImage* const& list) {
    finishList(succeeded, count, list);
}

// ---- what stands for a function ------------------------------------------------------------------------------------

template <Function F, class Pfn>
struct Failing;

template <Function F, class Handle, class... Args>
struct Failing<F, VkResult(VKAPI_PTR*)(Handle, Args...)> {
    static VKAPI_ATTR VkResult VKAPI_CALL call(Handle handle, Args... args) {
        const void* key = keyOf(handle);
        const uint64_t surface = (uint64_t{0} | ... | surfaceIn(args));
        const VkResult fault = Faults::get().decide(F, key, surface);
        VkResult result = fault;
        if (fault == VK_ERROR_DEVICE_LOST) {
            endWork(chainOf(key));
        }
        if (fault >= 0) {
            using Next = VkResult(VKAPI_PTR*)(Handle, Args...);
            result = reinterpret_cast<Next>(chainOf(key).find(functions[F].name))(handle, args...);
        }
        finish(F, key, result >= 0, args...);
        return result == VK_SUCCESS ? fault : result;
    }
};

template <class Pfn>
struct Destroying;

template <class Handle, class Object>
struct Destroying<void(VKAPI_PTR*)(Handle, Object, const VkAllocationCallbacks*)> {
    template <const char* const& name>
    static VKAPI_ATTR void VKAPI_CALL call(Handle handle, Object object, const VkAllocationCallbacks* host) {
        const void* key = keyOf(handle);
        if (object == VK_NULL_HANDLE || !Faults::get().ended(name, key, bits(object))) {
            return;
        }
        using Next = void(VKAPI_PTR*)(Handle, Object, const VkAllocationCallbacks*);
        reinterpret_cast<Next>(chainOf(key).find(name))(handle, object, host);
    }
};

// ---- instances and devices -----------------------------------------------------------------------------------------

template <class LayerInfo>
LayerInfo* linkIn(const void* next, VkStructureType type) {
    auto* info = static_cast<LayerInfo*>(const_cast<void*>(next));
    while (info != nullptr && (info->sType != type || info->function != VK_LAYER_LINK_INFO)) {
        info = static_cast<LayerInfo*>(const_cast<void*>(info->pNext));
    }
    return info;
}

VKAPI_ATTR VkResult VKAPI_CALL createInstance(const VkInstanceCreateInfo* info, const VkAllocationCallbacks* host,
                                              VkInstance* instance) {
    auto* link = linkIn<VkLayerInstanceCreateInfo>(info->pNext, VK_STRUCTURE_TYPE_LOADER_INSTANCE_CREATE_INFO);
    if (link == nullptr) {
        return VK_ERROR_INITIALIZATION_FAILED;
    }
    if (const VkResult fault = Faults::get().decide(f_vkCreateInstance, nullptr, 0); fault != VK_SUCCESS) {
        return fault;
    }
    const PFN_vkGetInstanceProcAddr lookUp = link->u.pLayerInfo->pfnNextGetInstanceProcAddr;
    link->u.pLayerInfo = link->u.pLayerInfo->pNext;
    const auto create = reinterpret_cast<PFN_vkCreateInstance>(lookUp(VK_NULL_HANDLE, "vkCreateInstance"));
    const VkResult result = create(info, host, instance);
    if (result == VK_SUCCESS) {
        Faults::get().made(f_vkCreateInstance, nullptr, bits(*instance));
        addChain(*instance, {*instance, VK_NULL_HANDLE, lookUp, nullptr, {}}, lookUp);
    }
    return result;
}

VKAPI_ATTR VkResult VKAPI_CALL createDevice(VkPhysicalDevice physical, const VkDeviceCreateInfo* info,
                                            const VkAllocationCallbacks* host, VkDevice* device) {
    auto* link = linkIn<VkLayerDeviceCreateInfo>(info->pNext, VK_STRUCTURE_TYPE_LOADER_DEVICE_CREATE_INFO);
    if (link == nullptr) {
        return VK_ERROR_INITIALIZATION_FAILED;
    }
    if (const VkResult fault = Faults::get().decide(f_vkCreateDevice, nullptr, 0); fault != VK_SUCCESS) {
        return fault;
    }
    const PFN_vkGetInstanceProcAddr lookUp = link->u.pLayerInfo->pfnNextGetInstanceProcAddr;
    const PFN_vkGetDeviceProcAddr lookUpDevice = link->u.pLayerInfo->pfnNextGetDeviceProcAddr;
    link->u.pLayerInfo = link->u.pLayerInfo->pNext;
    const Chain& above = chainOf(keyOf(physical));
    const VkInstance instance = above.instance;
    const auto create = reinterpret_cast<PFN_vkCreateDevice>(above.find("vkCreateDevice"));
    const VkResult result = create(physical, info, host, device);
    if (result == VK_SUCCESS) {
        Faults::get().made(f_vkCreateDevice, keyOf(physical), bits(*device));
        addChain(*device, {instance, *device, lookUp, lookUpDevice, {}}, lookUpDevice);
    }
    return result;
}

template <class Handle>
void endChain(Handle handle, const char* name, const VkAllocationCallbacks* host) {
    if (handle == VK_NULL_HANDLE) {
        return;
    }
    const void* key = keyOf(handle);
    using Next = void(VKAPI_PTR*)(Handle, const VkAllocationCallbacks*);
    const auto next = reinterpret_cast<Next>(chainOf(key).find(name));
    Faults::get().endOwner(key);
    {
        const std::scoped_lock lock(chainMutex);
        chains().erase(key);
    }
    next(handle, host);
}

VKAPI_ATTR void VKAPI_CALL destroyInstance(VkInstance instance, const VkAllocationCallbacks* host) {
    if (instance == VK_NULL_HANDLE || Faults::get().ended("vkDestroyInstance", nullptr, bits(instance))) {
        endChain(instance, "vkDestroyInstance", host);
    }
}

VKAPI_ATTR void VKAPI_CALL destroyDevice(VkDevice device, const VkAllocationCallbacks* host) {
    if (device == VK_NULL_HANDLE || Faults::get().ended("vkDestroyDevice", nullptr, bits(device))) {
        endChain(device, "vkDestroyDevice", host);
    }
}

// ---- look-up -------------------------------------------------------------------------------------------------------

#define REFLET_NAME(creating, destroying, ...) constexpr const char* n_##creating = #destroying;
REFLET_CREATING(REFLET_NAME)
#undef REFLET_NAME

PFN_vkVoidFunction ownFunction(const char* name) {
    struct Entry {
        const char* name;
        PFN_vkVoidFunction function;
    };
    static const Entry entries[] = {
#define REFLET_FAILING(function, ...) \
    {#function, reinterpret_cast<PFN_vkVoidFunction>(Failing<f_##function, PFN_##function>::call)},
#define REFLET_DESTROYING(creating, destroying, ...) \
    {#destroying, reinterpret_cast<PFN_vkVoidFunction>(Destroying<PFN_##destroying>::call<n_##creating>)},
        REFLET_CREATING(REFLET_FAILING) REFLET_OTHER(REFLET_FAILING) REFLET_CREATING(REFLET_DESTROYING)
#undef REFLET_FAILING
#undef REFLET_DESTROYING
            {"vkCreateInstance", reinterpret_cast<PFN_vkVoidFunction>(createInstance)},
        {"vkDestroyInstance", reinterpret_cast<PFN_vkVoidFunction>(destroyInstance)},
        {"vkCreateDevice", reinterpret_cast<PFN_vkVoidFunction>(createDevice)},
        {"vkDestroyDevice", reinterpret_cast<PFN_vkVoidFunction>(destroyDevice)}};
    for (const Entry& entry : entries) {
        if (std::strcmp(entry.name, name) == 0) {
            return entry.function;
        }
    }
    return nullptr;
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL lookUpInDevice(VkDevice device, const char* name) {
    if (std::strcmp(name, "vkGetDeviceProcAddr") == 0) {
        return reinterpret_cast<PFN_vkVoidFunction>(lookUpInDevice);
    }
    const PFN_vkVoidFunction next = chainOf(keyOf(device)).lookUpDevice(device, name);
    const PFN_vkVoidFunction own = ownFunction(name);
    return next != nullptr && own != nullptr ? own : next;
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL lookUpInInstance(VkInstance instance, const char* name) {
    if (std::strcmp(name, "vkGetInstanceProcAddr") == 0) {
        return reinterpret_cast<PFN_vkVoidFunction>(lookUpInInstance);
    }
    if (std::strcmp(name, "vkGetDeviceProcAddr") == 0) {
        return reinterpret_cast<PFN_vkVoidFunction>(lookUpInDevice);
    }
    const PFN_vkVoidFunction own = ownFunction(name);
    if (instance == VK_NULL_HANDLE) {
        return own;
    }
    const PFN_vkVoidFunction next = chainOf(keyOf(instance)).lookUpInstance(instance, name);
    return next != nullptr && own != nullptr ? own : next;
}

// The library is never unloaded (-z nodelete), so this runs when the process exits in the ordinary way.
struct AtExit {
    ~AtExit() { Faults::get().finishReport(); }
} atExit;

}  // namespace

}  // namespace reflet::fault

extern "C" {

VK_LAYER_EXPORT VKAPI_ATTR VkResult VKAPI_CALL vkNegotiateLoaderLayerInterfaceVersion(VkNegotiateLayerInterface* its) {
    if (its->loaderLayerInterfaceVersion < 2) {
        return VK_ERROR_INITIALIZATION_FAILED;
    }
    its->loaderLayerInterfaceVersion = 2;
    its->pfnGetInstanceProcAddr = reflet::fault::lookUpInInstance;
    its->pfnGetDeviceProcAddr = reflet::fault::lookUpInDevice;
    its->pfnGetPhysicalDeviceProcAddr = nullptr;
    return VK_SUCCESS;
}

/// For tests in the same process.
VK_LAYER_EXPORT void* refletFaults() {
    return &reflet::fault::Faults::get();
}
}
