// Runs a GLSL function on the device.
#include "shader/harness.h"

#include "base/error.h"
#include "gpu/shader.h"

#include <cstring>

std::span<const reflet::gpu::EmbeddedShader> shaderTestShaders();

namespace reflet::test {

namespace {

// Waiting for the device does not by itself let the host see what it wrote.
void showToHost(gpu::Device& device) {
    device.runNow([&](VkCommandBuffer commands) {
        VkMemoryBarrier2 barrier{VK_STRUCTURE_TYPE_MEMORY_BARRIER_2};
        barrier.srcStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
        barrier.srcAccessMask = VK_ACCESS_2_MEMORY_WRITE_BIT;
        barrier.dstStageMask = VK_PIPELINE_STAGE_2_HOST_BIT;
        barrier.dstAccessMask = VK_ACCESS_2_HOST_READ_BIT;
        VkDependencyInfo info{VK_STRUCTURE_TYPE_DEPENDENCY_INFO};
        info.memoryBarrierCount = 1;
        info.pMemoryBarriers = &barrier;
        device.vk.vkCmdPipelineBarrier2(commands, &info);
    });
}

}  // namespace

void ShaderTest::registerTestShaders() {
    static const bool registered = (gpu::registerShaders(shaderTestShaders()), true);
    (void)registered;
}

void ShaderTest::runShader(std::string_view shader, const Io& io) {
    REFLET_CHECK(io.threads > 0, "{}: no inputs", shader);
    registerTestShaders();
    constexpr VkBufferUsageFlags storage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT;
    const gpu::Buffer inputs(device(), io.inputs.size(), storage, gpu::MemoryUse::upload, "inputs");
    const gpu::Buffer outputs(device(), io.outputs.size(), storage, gpu::MemoryUse::readback, "outputs");
    std::memcpy(inputs.bytes().data(), io.inputs.data(), io.inputs.size());
    gpu::Frame& f = frame();
    f.begin();
    gpu::Pass pass = f.compute(shader, shader);
    pass.read("inputs", inputs.view()).write("outputs", outputs.view());
    if (!io.params.empty()) {
        pass.uniform("params", io.params);
    }
    if (io.bind) {
        io.bind(pass);
    }
    pass.dispatch(io.threads);
    f.submit();
    f.wait();
    showToHost(device());
    std::memcpy(io.outputs.data(), outputs.bytes().data(), io.outputs.size());
}

}  // namespace reflet::test
