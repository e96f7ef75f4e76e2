// A driver's pipeline cache that is kept in a file from run to run, so that shaders are compiled once for a driver and
// not once for a run. The file is no more than a help: whatever is wrong with it, the device works without it.
#pragma once

#include <volk.h>

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace reflet::gpu {

/// The content of such a file.
std::string pipelineFile(std::string_view data);
/// The driver's data in the content of a file; none if it is damaged, or of another device or driver.
std::optional<std::string> pipelineData(std::string_view file, const VkPhysicalDeviceProperties& device);

class KeptPipelines {
public:
    /// Creates the cache with what the folder's file for this device and driver has, if there is one. The functions and
    /// the device must outlive it.
    KeptPipelines(const VolkDeviceTable& functions, VkDevice device, const VkPhysicalDeviceProperties& properties,
                  const std::filesystem::path& folder);
    /// Writes the file if the driver has anything new for it. Of programs that run at the same time, the last one wins.
    ~KeptPipelines();
    KeptPipelines(const KeptPipelines&) = delete;
    KeptPipelines& operator=(const KeptPipelines&) = delete;

    /// Null if the driver has refused to create one.
    [[nodiscard]] VkPipelineCache handle() const { return handle_; }
    [[nodiscard]] const std::filesystem::path& file() const { return file_; }

private:
    void load(const VkPhysicalDeviceProperties& properties);
    void save() const;

    const VolkDeviceTable& functions_;
    VkDevice device_;
    std::filesystem::path file_;
    std::string loaded_;  ///< the driver's data in the file
    VkPipelineCache handle_ = VK_NULL_HANDLE;
};

}  // namespace reflet::gpu
