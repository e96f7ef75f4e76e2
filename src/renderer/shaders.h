// The shaders of all passes, embedded by the build; to be added to each device that records passes.
#pragma once

#include "gpu/shader.h"

std::span<const reflet::gpu::Shader> effectShaders();
std::span<const reflet::gpu::Shader> rendererShaders();
