// Shaders of tests that record their own passes into frames, and images made by them.
#pragma once

#include "base/math.h"
#include "device/frame.h"
#include "device/upload.h"
#include "gpu/context.h"

#include <span>
#include <vector>

std::span<const reflet::gpu::Shader> passTestShaders();

namespace reflet::test {

inline void addPassTestShaders(gpu::Context& context) {
    context.shaders().add(passTestShaders());
}

/// Puts values into an image by one of the shaders that fill.
class Filler {
public:
    Filler(gpu::Frame& frame, uvec2 size) : frame_(frame), size_(size) {}

    template <class T>
    gpu::Image fill(const char* name, VkFormat format, const char* shader, const std::vector<T>& texels) {
        uploads_.push_back(gpu::uploadBuffer(frame_.device(), std::as_bytes(std::span(texels)),
                                             VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, name));
        const gpu::Image image = frame_.image(name, format, size_);
        frame_.compute(name, shader).read("inputs", uploads_.back().view()).write("image", image).dispatch(size_);
        return image;
    }
    gpu::Image colors(const char* name, const std::vector<vec4>& texels) {
        return fill(name, VK_FORMAT_R16G16B16A16_SFLOAT, "fill_color_test.comp", texels);
    }

private:
    gpu::Frame& frame_;
    uvec2 size_;
    std::vector<gpu::Buffer> uploads_;
};

}  // namespace reflet::test
