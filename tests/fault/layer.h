// The layer that makes calls fail, in this process rather than in one that a test runs.
#pragma once

#include "fault/faults.h"

#include <dlfcn.h>

#include <cstdlib>

namespace reflet::fault {

/// While it lives, Vulkan instances that are created have the layer, and those that validate can load their own.
class WithLayer {
public:
    // NOLINTBEGIN(concurrency-mt-unsafe): one thread
    WithLayer() {
        const char* folders = REFLET_FAULT_LAYER_FOLDER
            ":/usr/share/vulkan/explicit_layer.d:/usr/local/share/vulkan/explicit_layer.d:/etc/vulkan/explicit_layer.d";
        ::setenv("VK_INSTANCE_LAYERS", "VK_LAYER_REFLET_fault", 1);
        ::setenv("VK_LAYER_PATH", folders, 1);
    }
    ~WithLayer() {
        ::unsetenv("VK_INSTANCE_LAYERS");
        ::unsetenv("VK_LAYER_PATH");
    }
    // NOLINTEND(concurrency-mt-unsafe)
    WithLayer(const WithLayer&) = delete;
    WithLayer& operator=(const WithLayer&) = delete;
};

/// The faults of the layer that an instance has loaded; nullptr: none has. The layer owns them.
inline Faults* faultsOfLayer() {
    void* layer = ::dlopen(REFLET_FAULT_LAYER, RTLD_NOW | RTLD_NOLOAD);
    const auto find = layer == nullptr ? nullptr : reinterpret_cast<void* (*)()>(::dlsym(layer, "refletFaults"));
    return find == nullptr ? nullptr : static_cast<Faults*>(find());
}

}  // namespace reflet::fault
