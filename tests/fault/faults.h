// Decides which calls fail, and keeps account of objects. Shared by all instances and devices of a process.
#pragma once

#include "fault/functions.h"

#include <cstdint>
#include <map>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <utility>

namespace reflet::fault {

/// The fault to make: the call of this number (from 1) of the function.
struct Fault {
    Function function = functionCount;
    uint64_t call = 0;
    VkResult result = VK_SUCCESS;
    bool always = false;  ///< that call and all later ones
};

/// "vkAllocateMemory:3:VK_ERROR_OUT_OF_DEVICE_MEMORY", or "…:3+:…": that call and all later ones. None for anything
/// else.
std::optional<Fault> parseFault(const std::string& text);

class Faults {
public:
    /// Of this process. Reads REFLET_FAULT and REFLET_FAULT_REPORT.
    static Faults& get();

    // For tests that have the layer in their own process.
    /// Replaces the fault and starts counting again. What was lost is found again.
    void arm(std::optional<Fault> fault);
    /// Whether calls are counted and made to fail.
    void setActive(bool active);
    /// How often a call was made to fail since arm().
    [[nodiscard]] uint64_t hits() const;
    [[nodiscard]] uint64_t calls(Function function) const;

    /// Counts the call. Returns VK_SUCCESS if it shall go on, and otherwise its result. device, surface: those that it
    /// concerns, if any; what was lost once stays lost.
    VkResult decide(Function function, const void* device, uint64_t surface);

    void made(Function creating, const void* owner, uint64_t object);
    /// False if no such object is alive. owner: of the object; null: any.
    bool ended(const char* destroying, const void* owner, uint64_t object);
    /// Ends an instance or device: what it still has is a leak.
    void endOwner(const void* owner);
    void bind(uint64_t swapchain, uint64_t surface);
    [[nodiscard]] uint64_t surfaceOf(uint64_t swapchain) const;

    /// Objects that are alive, as "vkCreateBuffer 3, …"; empty: none.
    [[nodiscard]] std::string alive() const;
    /// Lines about leaked objects and about the destruction of what does not exist.
    [[nodiscard]] std::string misuses() const;

    /// Writes the end of the report: calls of each function, and what is alive.
    void finishReport();

private:
    Faults();
    void report(const std::string& line);
    void complain(const std::string& line);
    [[nodiscard]] std::string aliveOf(const void* owner) const;

    mutable std::mutex mutex_;
    std::string reportFile_;
    std::optional<Fault> fault_;
    bool active_ = true;
    uint64_t hits_ = 0;
    std::array<uint64_t, functionCount> calls_{};
    std::set<const void*> lostDevices_;
    std::set<uint64_t> lostSurfaces_;
    std::map<uint64_t, uint64_t> surfaces_;  ///< of swapchains
    struct Object {
        Function creating;
        const void* owner;
    };
    std::map<std::pair<std::string, uint64_t>, Object> objects_;  ///< by destroying function and handle
    std::string misuses_;
};

}  // namespace reflet::fault
