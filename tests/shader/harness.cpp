// Runs a GLSL function on the device.
#include "shader/harness.h"

#include "base/error.h"
#include "gpu/shader.h"

#include <cstring>

std::span<const reflet::gpu::Shader> shaderTestShaders();

namespace reflet::test {

void ShaderTest::registerTestShaders() {
    device().shaders().add(shaderTestShaders());
}

void ShaderTest::record(const std::function<void(gpu::Frame&)>& passes) {
    registerTestShaders();
    frame().begin();
    passes(frame());
    frame().submit();
    frame().wait();
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
    gpu::ComputePass pass = f.compute(shader, shader);
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
    showToHost();
    std::memcpy(io.outputs.data(), outputs.bytes().data(), io.outputs.size());
}

}  // namespace reflet::test
