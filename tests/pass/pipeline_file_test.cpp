// The driver's pipeline cache in a file: kept from device to device, and whatever is wrong with the file only ignored.
#include "device/pipeline_file.h"

#include "base/file.h"
#include "base/home.h"
#include "support/device_fixture.h"

#include <cstdlib>
#include <cstring>

namespace reflet::test::pipeline_file_test {
namespace {

namespace fs = std::filesystem;
using gpu::KeptPipelines;
using gpu::pipelineData;
using gpu::pipelineFile;

VkPhysicalDeviceProperties someDevice() {
    VkPhysicalDeviceProperties p{};
    p.vendorID = 0x10DE;
    p.deviceID = 0x2204;
    p.driverVersion = 7;
    p.pipelineCacheUUID[3] = 0xAB;
    return p;
}

std::string dataOf(const VkPhysicalDeviceProperties& device, const std::string& content) {
    VkPipelineCacheHeaderVersionOne head{};
    head.headerSize = sizeof(head);
    head.headerVersion = VK_PIPELINE_CACHE_HEADER_VERSION_ONE;
    head.vendorID = device.vendorID;
    head.deviceID = device.deviceID;
    std::memcpy(head.pipelineCacheUUID, device.pipelineCacheUUID, VK_UUID_SIZE);
    std::string data(sizeof(head), '\0');
    std::memcpy(data.data(), &head, sizeof(head));
    return data + content;
}

TEST(PipelineFile, GivesBackWhatWasWritten) {
    const std::string data = dataOf(someDevice(), std::string("compiled\0shaders", 16));
    EXPECT_EQ(pipelineData(pipelineFile(data), someDevice()), data);
}

TEST(PipelineFile, NoDamagedByteReachesTheDriver) {
    const std::string file = pipelineFile(dataOf(someDevice(), "compiled shaders"));
    for (size_t i = 0; i < file.size(); ++i) {
        std::string damaged = file;
        damaged[i] = static_cast<char>(damaged[i] ^ 4);
        EXPECT_FALSE(pipelineData(damaged, someDevice())) << i;
        EXPECT_FALSE(pipelineData(file.substr(0, i), someDevice())) << i;
    }
    EXPECT_FALSE(pipelineData(file + "x", someDevice()));
}

TEST(PipelineFile, AnotherDeviceOrDriverIsNotServed) {
    const std::string file = pipelineFile(dataOf(someDevice(), "compiled shaders"));
    VkPhysicalDeviceProperties other = someDevice();
    other.deviceID += 1;
    EXPECT_FALSE(pipelineData(file, other));
    other = someDevice();
    other.pipelineCacheUUID[15] = 1;
    EXPECT_FALSE(pipelineData(file, other));
}

// A driver that keeps what it is given and appends a word for each run. Vulkan's functions have no place for its state.
struct Driver {
    static inline std::string given;
    static inline bool refuses = false;
    static inline int alive = 0;

    static VKAPI_ATTR VkResult VKAPI_CALL create(VkDevice /*device*/, const VkPipelineCacheCreateInfo* info,
                                                 const VkAllocationCallbacks* /*allocator*/, VkPipelineCache* cache) {
        if (refuses) {
            return VK_ERROR_OUT_OF_HOST_MEMORY;
        }
        given.assign(static_cast<const char*>(info->pInitialData), info->initialDataSize);
        std::memset(cache, 1, sizeof(*cache));
        ++alive;
        return VK_SUCCESS;
    }
    static VKAPI_ATTR VkResult VKAPI_CALL data(VkDevice /*device*/, VkPipelineCache /*cache*/, size_t* size, void* to) {
        const std::string all = (given.empty() ? dataOf(someDevice(), "") : given) + " run";
        if (to != nullptr) {
            std::memcpy(to, all.data(), all.size());
        }
        *size = all.size();
        return VK_SUCCESS;
    }
    static VKAPI_ATTR void VKAPI_CALL destroy(VkDevice /*device*/, VkPipelineCache /*cache*/,
                                              const VkAllocationCallbacks* /*allocator*/) {
        --alive;
    }
};

class KeptPipelineFile : public ::testing::Test {
protected:
    KeptPipelineFile() : folder_(fs::path(::testing::TempDir()) / "reflet_pipelines" / "deeper") {
        fs::remove_all(folder_.parent_path());
        functions_.vkCreatePipelineCache = Driver::create;
        functions_.vkGetPipelineCacheData = Driver::data;
        functions_.vkDestroyPipelineCache = Driver::destroy;
        Driver::refuses = false;
    }
    ~KeptPipelineFile() override {
        EXPECT_EQ(Driver::alive, 0);
        fs::remove_all(folder_.parent_path());
    }
    // The data that the driver is given, after the header.
    std::string run() {
        const KeptPipelines kept(functions_, VK_NULL_HANDLE, someDevice(), folder_);
        file_ = kept.file();
        EXPECT_EQ(kept.handle() == VK_NULL_HANDLE, Driver::refuses);
        return Driver::given.empty() ? "" : Driver::given.substr(sizeof(VkPipelineCacheHeaderVersionOne));
    }

    VolkDeviceTable functions_{};
    fs::path folder_;
    fs::path file_;
};

TEST_F(KeptPipelineFile, EachRunHasWhatTheOnesBeforeCompiled) {
    EXPECT_EQ(run(), "");
    EXPECT_EQ(run(), " run");
    EXPECT_EQ(run(), " run run");
}

TEST_F(KeptPipelineFile, ADamagedFileIsReplaced) {
    run();
    writeFileAtomically(file_, "no pipelines");
    EXPECT_EQ(run(), "");
    EXPECT_EQ(run(), " run");
}

TEST_F(KeptPipelineFile, WithoutAFolderOrACacheTheDeviceWorks) {
    fs::create_directories(folder_.parent_path());
    writeFileAtomically(folder_, "a file where the folder should be");
    EXPECT_EQ(run(), "");
    EXPECT_EQ(run(), "");
    Driver::refuses = true;
    run();
}

class DeviceWithFolder : public DeviceTest {};

// Of this machine's driver, whether it keeps anything or not; twice, so that a file is read where one was written.
TEST_F(DeviceWithFolder, PassesUnderTheValidationLayers) {
    const fs::path folder = fs::path(::testing::TempDir()) / "reflet_real_pipelines";
    fs::remove_all(folder);
    for (int i = 0; i < 2; ++i) {
        const gpu::Device device({.validation = true, .pipelineFolder = folder});
        EXPECT_TRUE(device.validationMessages().empty());
    }
    fs::remove_all(folder);
}

TEST(CacheFolder, IsTheUsers) {
    ::setenv("XDG_CACHE_HOME", "/somewhere", 1);
    EXPECT_EQ(cacheFolder(), fs::path("/somewhere/reflet"));
    ::unsetenv("XDG_CACHE_HOME");
    const auto home = homeFolder();
    EXPECT_EQ(cacheFolder(), home ? std::optional(*home / ".cache" / "reflet") : std::nullopt);
}

}  // namespace
}  // namespace reflet::test::pipeline_file_test
