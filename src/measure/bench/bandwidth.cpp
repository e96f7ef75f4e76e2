// Measures bandwidth by copying images and buffers.
#include "measure/bench/bandwidth.h"

#include "device/frame.h"
#include "renderer/live/live_picture.h"

#include <algorithm>

namespace reflet {

namespace {

constexpr int copies = 5;
constexpr uvec2 imageSize{4096, 4096};
constexpr VkDeviceSize bufferBytes = VkDeviceSize(8) * imageSize.x * imageSize.y;

double perSecond(uint64_t bytes, double ms) {
    return ms > 0.0 ? static_cast<double>(bytes) / (ms * 1e-3) : 0.0;
}

double copyImages(gpu::Frame& f) {
    f.begin();
    const gpu::Image from = f.image("from", VK_FORMAT_R16G16B16A16_SFLOAT, imageSize);
    const gpu::Image to = f.image("to", VK_FORMAT_R16G16B16A16_SFLOAT, imageSize);
    showLive(f, from, to);
    f.keep(to);
    f.submit();
    f.wait();
    return perSecond(bytesOf(from) + bytesOf(to), f.passTimes().back().ms);
}

// Timed by the host: a driver may execute the copy where device timestamps do not measure it.
double copyBuffers(gpu::Device& device, gpu::BufferView from, gpu::BufferView to) {
    const auto start = std::chrono::steady_clock::now();
    device.runNow([&](VkCommandBuffer commands) {
        const VkBufferCopy all{0, 0, from.size};
        device.vk.vkCmdCopyBuffer(commands, from.state->buffer, to.state->buffer, 1, &all);
    });
    const std::chrono::duration<double, std::milli> ms = std::chrono::steady_clock::now() - start;
    return perSecond(from.size + to.size, ms.count());
}

}  // namespace

double measureBandwidth(gpu::Device& device) {
    double best = 0.0;
    gpu::Frame f(device);
    for (int i = 0; i < copies; ++i) {
        best = std::max(best, copyImages(f));
    }
    const auto usage = VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT;
    const gpu::Buffer from(device, bufferBytes, usage, gpu::MemoryUse::device, "bandwidth");
    const gpu::Buffer to(device, bufferBytes, usage, gpu::MemoryUse::device, "bandwidth");
    for (int i = 0; i < copies; ++i) {
        best = std::max(best, copyBuffers(device, from.view(), to.view()));
    }
    return best;
}

}  // namespace reflet
