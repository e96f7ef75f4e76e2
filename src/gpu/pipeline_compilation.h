// Compiles pipelines, on several threads.
#pragma once

#include "gpu/pipeline.h"

#include <exception>
#include <memory>
#include <vector>

namespace reflet::gpu {

/// Destroys the pipeline's Vulkan objects, which no pending command may use.
void destroyPipeline(Context& context, const Pipeline& pipeline);

/// A pipeline being compiled; destroys its objects unless take() was called.
class PipelineCompilation {
public:
    /// The info must outlive this. Throws std::logic_error: an unknown shader; Error: Vulkan refuses a layout.
    PipelineCompilation(Context& context, const PipelineInfo& info, const ShaderInterface& interface);
    ~PipelineCompilation();
    PipelineCompilation(const PipelineCompilation&) = delete;
    PipelineCompilation& operator=(const PipelineCompilation&) = delete;

    /// May run on any thread. Exceptions are stored in failure().
    void compile(VkPipelineCache cache) noexcept;

    [[nodiscard]] const PipelineInfo& info() const { return info_; }
    [[nodiscard]] const std::exception_ptr& failure() const { return failure_; }
    [[nodiscard]] std::unique_ptr<Pipeline> take() { return std::move(pipeline_); }
    /// Words of SPIR-V of all stages: a measure of how long compilation takes.
    [[nodiscard]] size_t words() const;

private:
    Context& context_;
    const PipelineInfo& info_;
    std::vector<Shader> shaders_;
    std::unique_ptr<Pipeline> pipeline_;
    std::exception_ptr failure_;
};

/// Compiles all of them on at most this many threads, the calling one among them, largest first; sorts them for that.
void compileAll(std::vector<std::unique_ptr<PipelineCompilation>>& all, VkPipelineCache cache, uint32_t threads);

}  // namespace reflet::gpu
