// Counts calls and objects, and writes the report.
#include "fault/faults.h"

#include <algorithm>
#include <charconv>
#include <cstdio>
#include <cstdlib>
#include <string_view>

namespace reflet::fault {

namespace {

const char* destroyingOf(Function creating) {
    switch (creating) {
#define REFLET_CASE(name, destroying, ...) \
    case f_##name:                         \
        return #destroying;
        REFLET_CREATING(REFLET_CASE)
#undef REFLET_CASE
        case f_vkCreateInstance:
            return "vkDestroyInstance";
        case f_vkCreateDevice:
            return "vkDestroyDevice";
        default:
            return "";
    }
}

std::string variable(const char* name) {
    const char* text = std::getenv(name);  // NOLINT(concurrency-mt-unsafe): nothing changes the environment meanwhile
    return text == nullptr ? "" : text;
}

}  // namespace

std::optional<Fault> parseFault(const std::string& text) {
    const size_t first = text.find(':');
    const size_t second = text.find(':', first + 1);
    if (first == std::string::npos || second == std::string::npos) {
        return std::nullopt;
    }
    const std::string_view name = std::string_view(text).substr(0, first);
    const std::string_view result = std::string_view(text).substr(second + 1);
    const auto function = std::ranges::find(functions, name, &FunctionInfo::name);
    const auto known = std::ranges::find(resultNames, result, &ResultName::name);
    Fault fault;
    const char* end = text.data() + second;
    const auto number = std::from_chars(text.data() + first + 1, end, fault.call);
    fault.always = number.ptr + 1 == end && *number.ptr == '+';
    if (function == functions.end() || known == std::end(resultNames) || number.ec != std::errc() ||
        (number.ptr != end && !fault.always)) {
        return std::nullopt;
    }
    fault.function = static_cast<Function>(function - functions.begin());
    fault.result = known->result;
    return fault;
}

Faults& Faults::get() {
    static auto* faults = new Faults;  // never destroyed: the program's own exit handlers may still call Vulkan
    return *faults;
}

Faults::Faults() : reportFile_(variable("REFLET_FAULT_REPORT")) {
    const std::string text = variable("REFLET_FAULT");
    fault_ = parseFault(text);
    if (!text.empty() && !fault_) {
        report("REFLET_FAULT is not understood: " + text);
    }
}

void Faults::arm(std::optional<Fault> fault) {
    const std::scoped_lock lock(mutex_);
    fault_ = fault;
    hits_ = 0;
    calls_ = {};
    misuses_.clear();
    lostDevices_.clear();
    lostSurfaces_.clear();
}

void Faults::setActive(bool active) {
    const std::scoped_lock lock(mutex_);
    active_ = active;
}

uint64_t Faults::hits() const {
    const std::scoped_lock lock(mutex_);
    return hits_;
}

uint64_t Faults::calls(Function function) const {
    const std::scoped_lock lock(mutex_);
    return calls_.at(function);
}

VkResult Faults::decide(Function function, const void* device, uint64_t surface) {
    const std::scoped_lock lock(mutex_);
    if (!active_) {
        return VK_SUCCESS;
    }
    const uint64_t call = ++calls_.at(function);
    const FunctionInfo& info = functions.at(function);
    if (lostDevices_.contains(device) && info.mayReturn(VK_ERROR_DEVICE_LOST)) {
        return VK_ERROR_DEVICE_LOST;
    }
    if (lostSurfaces_.contains(surface) && info.mayReturn(VK_ERROR_SURFACE_LOST_KHR)) {
        return VK_ERROR_SURFACE_LOST_KHR;
    }
    if (!fault_ || fault_->function != function || call < fault_->call || (call > fault_->call && !fault_->always)) {
        return VK_SUCCESS;
    }
    ++hits_;
    report("hit " + std::string(info.name));
    if (fault_->result == VK_ERROR_DEVICE_LOST && function != f_vkCreateDevice) {
        lostDevices_.insert(device);
    }
    if (fault_->result == VK_ERROR_SURFACE_LOST_KHR) {
        lostSurfaces_.insert(surface);
    }
    return fault_->result;
}

void Faults::made(Function creating, const void* owner, uint64_t object) {
    const std::scoped_lock lock(mutex_);
    objects_[{destroyingOf(creating), object}] = {creating, owner};
}

bool Faults::ended(const char* destroying, const void* owner, uint64_t object) {
    const std::scoped_lock lock(mutex_);
    const auto found = objects_.find({destroying, object});
    if (found == objects_.end() || (owner != nullptr && found->second.owner != owner)) {
        complain("misuse " + std::string(destroying) + " of an object that is not alive");
        return false;
    }
    objects_.erase(found);
    surfaces_.erase(object);
    lostSurfaces_.erase(object);
    return true;
}

void Faults::endOwner(const void* owner) {
    const std::scoped_lock lock(mutex_);
    if (const std::string left = aliveOf(owner); !left.empty()) {
        complain("leak " + left);
    }
    std::erase_if(objects_, [&](const auto& object) { return object.second.owner == owner; });
    lostDevices_.erase(owner);
}

void Faults::bind(uint64_t swapchain, uint64_t surface) {
    const std::scoped_lock lock(mutex_);
    surfaces_[swapchain] = surface;
}

uint64_t Faults::surfaceOf(uint64_t swapchain) const {
    const std::scoped_lock lock(mutex_);
    const auto found = surfaces_.find(swapchain);
    return found == surfaces_.end() ? 0 : found->second;
}

std::string Faults::aliveOf(const void* owner) const {
    std::map<std::string, int> counts;
    for (const auto& [key, object] : objects_) {
        if (owner == nullptr || object.owner == owner) {
            ++counts[functions.at(object.creating).name];
        }
    }
    std::string text;
    for (const auto& [name, count] : counts) {
        text += (text.empty() ? "" : ", ") + name + " " + std::to_string(count);
    }
    return text;
}

std::string Faults::alive() const {
    const std::scoped_lock lock(mutex_);
    return aliveOf(nullptr);
}

std::string Faults::misuses() const {
    const std::scoped_lock lock(mutex_);
    return misuses_;
}

void Faults::complain(const std::string& line) {
    misuses_ += line + "\n";
    report(line);
}

void Faults::finishReport() {
    const std::scoped_lock lock(mutex_);
    for (size_t i = 0; i < functionCount; ++i) {
        if (calls_[i] > 0) {
            report("count " + std::string(functions[i].name) + " " + std::to_string(calls_[i]));
        }
    }
    if (const std::string left = aliveOf(nullptr); !left.empty()) {
        report("leak " + left);
    }
    report("end");
}

void Faults::report(const std::string& line) {
    if (reportFile_.empty()) {
        return;
    }
    if (std::FILE* file = std::fopen(reportFile_.c_str(), "a")) {
        std::fprintf(file, "%s\n", line.c_str());
        std::fclose(file);
    }
}

}  // namespace reflet::fault
