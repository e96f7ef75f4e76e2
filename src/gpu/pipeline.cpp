// The cache of pipelines and of what their shaders expect.
#include "gpu/pipeline.h"

#include "base/error.h"
#include "gpu/context.h"
#include "gpu/pipeline_compilation.h"

#include <algorithm>
#include <exception>
#include <iterator>

namespace reflet::gpu {

namespace {

// The bindings of all stages. The compiler numbers those of each stage from a base of its own, so that a name which two
// stages share has two bindings.
std::vector<ShaderBinding> mergeBindings(const std::vector<Shader>& shaders, uint32_t set) {
    std::vector<ShaderBinding> merged;
    for (const Shader& shader : shaders) {
        for (const ShaderBinding& b : shader.bindings) {
            if (b.set != set) {
                continue;
            }
            const auto same = std::ranges::find(merged, b.binding, &ShaderBinding::binding);
            if (same == merged.end()) {
                merged.push_back(b);
                continue;
            }
            REFLET_CHECK(same->name == b.name && same->type == b.type && same->blockSize == b.blockSize,
                         "{}: binding {} is '{}' here and '{}' in another stage", shader.name, b.binding, b.name,
                         same->name);
        }
    }
    return merged;
}

}  // namespace

PipelineCache::PipelineCache(Context& context, PipelineMaking making) : context_(context), making_(std::move(making)) {
    if (making_.driverCache == VK_NULL_HANDLE && making_.keepsData) {
        VkPipelineCacheCreateInfo info{VK_STRUCTURE_TYPE_PIPELINE_CACHE_CREATE_INFO};
        info.initialDataSize = making_.data.size();
        info.pInitialData = making_.data.data();
        vkCheck(context.vk.vkCreatePipelineCache(context.handle(), &info, context.allocator(), &own_),
                "creating a pipeline cache");
        making_.driverCache = own_;
    }
    making_.data = {};
}

PipelineCache::~PipelineCache() {
    clear();
    context_.vk.vkDestroyPipelineCache(context_.handle(), own_, context_.allocator());
}

std::vector<std::byte> PipelineCache::data() const {
    const DeviceFunctions& vk = context_.vk;
    size_t size = 0;
    vkCheck(vk.vkGetPipelineCacheData(context_.handle(), own_, &size, nullptr), "reading a pipeline cache");
    std::vector<std::byte> bytes(size);
    vkCheck(vk.vkGetPipelineCacheData(context_.handle(), own_, &size, bytes.data()), "reading a pipeline cache");
    bytes.resize(size);
    return bytes;
}

// Commands that are still recorded or in flight may use them.
void PipelineCache::clear() {
    for (const auto& [info, pipeline] : pipelines_) {
        context_.retire([&context = context_, retired = *pipeline] { destroyPipeline(context, retired); });
    }
    pipelines_.clear();
    interfaces_.clear();
    ++version_;
}

const ShaderInterface& PipelineCache::interfaceOf(std::span<const std::string_view> shaders) {
    const std::vector<std::string_view> key(shaders.begin(), shaders.end());
    const std::scoped_lock lock(mutex_);
    if (const auto known = interfaces_.find(key); known != interfaces_.end()) {
        return *known->second;
    }
    auto made = std::make_unique<ShaderInterface>();
    std::vector<Shader> stages;
    for (const std::string_view name : shaders) {
        const Shader& shader = stages.emplace_back(context_.shaders().find(name));
        made->shaders.push_back(shader.name);
        made->stages |= shader.stage;
        made->pushConstantSize = std::max(made->pushConstantSize, shader.pushConstantSize);
        std::ranges::transform(shader.constants, std::back_inserter(made->constants), &SpecializationConstant::name);
        if (shader.stage == VK_SHADER_STAGE_FRAGMENT_BIT) {
            made->colorOutputs.assign(shader.outputs.begin(), shader.outputs.end());
        }
    }
    made->localSize = stages.front().localSize;
    made->bindings = mergeBindings(stages, 0);
    std::ranges::sort(made->bindings, {}, &ShaderBinding::binding);  // as Vulkan takes dynamic offsets
    for (const ShaderBinding& b : made->bindings) {
        const auto first = std::ranges::find(made->bindings, b.name, &ShaderBinding::name);
        made->sameName.push_back(static_cast<uint32_t>(first - made->bindings.begin()));
    }
    return *interfaces_.emplace(made->shaders, std::move(made)).first->second;
}

const Pipeline& PipelineCache::get(const PipelineInfo& info) {
    const auto find = [&]() -> const Pipeline* {
        const std::scoped_lock lock(mutex_);
        const auto known = pipelines_.find(info);
        return known != pipelines_.end() ? known->second.get() : nullptr;
    };
    if (const Pipeline* known = find()) {
        return *known;
    }
    make({&info, 1});
    return *find();
}

void PipelineCache::make(std::span<const PipelineInfo> missing) {
    std::vector<std::unique_ptr<PipelineCompilation>> all;
    uint32_t shaders = 0;
    for (const PipelineInfo& info : missing) {
        all.push_back(std::make_unique<PipelineCompilation>(context_, info, interfaceOf(info.shaders)));
        shaders += static_cast<uint32_t>(info.shaders.size());
    }
    if (making_.onCompile) {
        compiles_ = true;
        making_.onCompile(shaders);
    }
    compileAll(all, making_.driverCache, making_.threads);
    std::exception_ptr failure;
    for (const std::unique_ptr<PipelineCompilation>& making : all) {
        if (making->failure()) {
            failure = making->failure();
            continue;
        }
        const std::scoped_lock lock(mutex_);
        if (const auto [place, isNew] = pipelines_.try_emplace(making->info()); isNew) {
            place->second = making->take();
            ++context_.counts().pipelines;
        }  // else another thread was first
    }
    if (failure) {
        std::rethrow_exception(failure);
    }
}

void PipelineCache::noteUsed() {
    if (compiles_.exchange(false)) {
        making_.onCompile(0);
    }
}

}  // namespace reflet::gpu
