// Shaders of tests that record their own passes into frames.
#pragma once

#include "gpu/context.h"

std::span<const reflet::gpu::Shader> passTestShaders();

namespace reflet::test {

inline void addPassTestShaders(gpu::Context& context) {
    context.shaders().add(passTestShaders());
}

}  // namespace reflet::test
