// Reads and writes pipeline caches.
#include "device/pipeline_file.h"

#include "base/error.h"
#include "base/file.h"

#include <xxhash.h>

#include <cstring>
#include <exception>

namespace reflet::gpu {

namespace {

namespace fs = std::filesystem;

constexpr std::string_view heading = "reflet pipelines 2\n";
constexpr size_t sumDigits = 16;
// A cache never forgets: with more than that it begins anew.
constexpr uint64_t mostBytes = uint64_t{256} << 20U;

// A damaged file must not reach the driver, which may believe what it reads.
std::string sumOf(std::string_view data) {
    return fmt::format("{:016x}", XXH3_64bits(data.data(), data.size()));
}

std::string fileName(const VkPhysicalDeviceProperties& p) {
    std::string uuid;
    for (const uint8_t byte : p.pipelineCacheUUID) {
        uuid += fmt::format("{:02x}", byte);
    }
    return fmt::format("{:04x}-{:04x}-{:08x}-{}.bin", p.vendorID, p.deviceID, p.driverVersion, uuid);
}

}  // namespace

std::string pipelineFile(std::string_view data) {
    return fmt::format("{}{}\n{}", heading, sumOf(data), data);
}

std::optional<std::string> pipelineData(std::string_view file, const VkPhysicalDeviceProperties& device) {
    const size_t start = heading.size() + sumDigits + 1;
    if (!file.starts_with(heading) || file.size() < start + sizeof(VkPipelineCacheHeaderVersionOne)) {
        return std::nullopt;
    }
    const std::string_view data = file.substr(start);
    VkPipelineCacheHeaderVersionOne head{};
    std::memcpy(&head, data.data(), sizeof(head));
    const bool sameDevice = head.vendorID == device.vendorID && head.deviceID == device.deviceID &&
                            std::memcmp(head.pipelineCacheUUID, device.pipelineCacheUUID, VK_UUID_SIZE) == 0;
    if (head.headerVersion != VK_PIPELINE_CACHE_HEADER_VERSION_ONE || !sameDevice ||
        file.substr(heading.size(), sumDigits + 1) != sumOf(data) + "\n") {
        return std::nullopt;
    }
    return std::string(data);
}

KeptPipelines::KeptPipelines(const VolkDeviceTable& functions, VkDevice device,
                             const VkPhysicalDeviceProperties& properties, const fs::path& folder)
    : functions_(functions), device_(device), file_(folder / fileName(properties)) {
    load(properties);
    VkPipelineCacheCreateInfo info{VK_STRUCTURE_TYPE_PIPELINE_CACHE_CREATE_INFO};
    info.initialDataSize = loaded_.size();
    info.pInitialData = loaded_.data();
    VkPipelineCache made = VK_NULL_HANDLE;
    if (functions_.vkCreatePipelineCache(device_, &info, nullptr, &made) == VK_SUCCESS) {
        handle_ = made;
    }
}

KeptPipelines::~KeptPipelines() {
    if (handle_ == VK_NULL_HANDLE) {
        return;
    }
    try {
        save();
    } catch (const std::exception&) {  // the next run compiles again
        loaded_.clear();
    }
    functions_.vkDestroyPipelineCache(device_, handle_, nullptr);
}

void KeptPipelines::load(const VkPhysicalDeviceProperties& properties) {
    try {
        if (fs::exists(file_)) {
            loaded_ = pipelineData(readFile(file_, mostBytes), properties).value_or("");
        }
    } catch (const std::exception&) {
        loaded_.clear();
    }
}

void KeptPipelines::save() const {
    size_t size = 0;
    if (functions_.vkGetPipelineCacheData(device_, handle_, &size, nullptr) != VK_SUCCESS ||
        size <= sizeof(VkPipelineCacheHeaderVersionOne) || size >= mostBytes) {
        return;  // some drivers keep nothing, or have a cache of their own
    }
    std::string data(size, '\0');
    if (functions_.vkGetPipelineCacheData(device_, handle_, &size, data.data()) != VK_SUCCESS) {
        return;
    }
    data.resize(size);
    if (data != loaded_) {
        fs::create_directories(file_.parent_path());
        writeFileAtomically(file_, pipelineFile(data), Lasting::no);
    }
}

}  // namespace reflet::gpu
