// The shaders of all passes, as the build embeds them; a device that records passes is given them.
#pragma once

#include "gpu/shader.h"

std::span<const reflet::gpu::Shader> effectShaders();
std::span<const reflet::gpu::Shader> rendererShaders();
