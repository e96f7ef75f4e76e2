// Declares passes, checked against their shaders.
#include "gpu/pass.h"

#include "base/error.h"
#include "gpu/pass_list.h"

#include <algorithm>

namespace reflet::gpu {

namespace {

VkPipelineStageFlags2 shaderStages(VkShaderStageFlags stages) {
    return (stages & VK_SHADER_STAGE_COMPUTE_BIT) != 0
               ? VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT
               : VK_PIPELINE_STAGE_2_VERTEX_SHADER_BIT | VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT;
}

constexpr Access colorAccess{VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT,
                             VK_ACCESS_2_COLOR_ATTACHMENT_READ_BIT | VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT, true};
constexpr Access depthAccess{
    VK_PIPELINE_STAGE_2_EARLY_FRAGMENT_TESTS_BIT | VK_PIPELINE_STAGE_2_LATE_FRAGMENT_TESTS_BIT,
    VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_READ_BIT | VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT, true};

template <class View>
void addUse(std::vector<std::pair<View, Access>>& uses, const View& view, const Access& access) {
    const auto same = std::ranges::find_if(uses, [&](const auto& u) { return u.first.state == view.state; });
    if (same == uses.end()) {
        uses.emplace_back(view, access);
    } else {
        same->second = merged(same->second, access);
    }
}

}  // namespace

void PassRecord::clearDeclarations() {
    info.shaders.clear();
    info.constants.clear();
    info.colorFormats.clear();
    info.depthFormat = VK_FORMAT_UNDEFINED;
    info.blends = false;
    info.vertices = nullptr;
    info.drawSet = VK_NULL_HANDLE;
    bound.clear();
    std::swap(slots, lastSlots);
    slots.clear();
    uniforms.clear();
    bytes.clear();
    groups = glm::uvec3(0);
    arguments = {};
    colors.clear();
    depth = {};
    clearDepth.reset();
    draw.reset();
    from = {};
    to = {};
    buffer = {};
    staging.reset();
    imageUses.clear();
    bufferUses.clear();
    boundBytes = 0;
    root = false;
}

uint32_t Pass::slotOf(std::string_view binding, bool uniform) const {
    const std::vector<ShaderBinding>& bindings = record_->interface->bindings;
    const size_t call = record_->slots.size();
    if (!uniform && call < record_->lastSlots.size()) {
        const uint32_t last = record_->lastSlots[call];
        if (last < bindings.size() && bindings[last].name == binding) {
            return last;
        }
    }
    const auto found = std::ranges::find(bindings, binding, &ShaderBinding::name);
    REFLET_CHECK(found != bindings.end(), "{}: the shader has no {} '{}'", record_->name,
                 uniform ? "uniform block" : "binding", binding);
    return static_cast<uint32_t>(found - bindings.begin());
}

void Pass::bind(std::string_view binding, Bound bound) {
    if (bound.write && bound.image && bound.image.state->unused) {
        bound.image = list_->unusedTarget(bound.image);  // shared ones would make passes wait for one another
    }
    const uint32_t slot = slotOf(binding, false);
    const ShaderBinding& declared = record_->interface->bindings[slot];
    if (!bound.image && !bound.buffer && !bound.structure) {
        const bool buffer = declared.type == VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
        const bool structure = declared.type == VK_DESCRIPTOR_TYPE_ACCELERATION_STRUCTURE_KHR;
        REFLET_CHECK(false, "{}: no {} is bound to '{}'", record_->name,
                     structure ? "acceleration structure"
                     : buffer  ? "buffer"
                               : "image",
                     binding);
    }
    checkAccess(declared, bound);
    record_->bound.push_back(bound);
    record_->slots.push_back(slot);
    const VkPipelineStageFlags2 stages = shaderStages(record_->interface->stages);
    const Access access = bound.write ? Access{stages, VK_ACCESS_2_SHADER_READ_BIT | VK_ACCESS_2_SHADER_WRITE_BIT, true}
                                      : Access{stages, VK_ACCESS_2_SHADER_READ_BIT, false};
    if (bound.image) {
        use(bound.image, access);
        record_->root = record_->root || (bound.write && bound.image.state->external);
        record_->boundBytes += bound.image.state->external ? 0 : bytesOf(bound.image);  // a host's may have any format
    } else if (bound.buffer) {
        use(bound.buffer, access);
        record_->boundBytes += bound.buffer.size;
    }
}

void Pass::setUniform(std::string_view binding, std::span<const std::byte> bytes) {
    const uint32_t slot = slotOf(binding, true);
    const ShaderBinding& declared = record_->interface->bindings[slot];
    REFLET_CHECK(declared.type == VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, "{}: the shader has no uniform block '{}'",
                 record_->name, binding);
    REFLET_CHECK(bytes.size() == declared.blockSize, "{}: '{}' has {} bytes here and {} in the shader", record_->name,
                 binding, bytes.size(), declared.blockSize);
    const auto offset = static_cast<uint32_t>(record_->bytes.size());
    record_->bytes.insert(record_->bytes.end(), bytes.begin(), bytes.end());
    const auto same = std::ranges::find(record_->uniforms, slot, &PassRecord::Uniform::slot);
    if (same != record_->uniforms.end()) {
        same->offset = offset;
    } else {
        record_->uniforms.push_back({slot, offset, static_cast<uint32_t>(bytes.size())});
    }
}

void Pass::setConstant(std::string_view name, uint32_t value) {
    const std::vector<std::string_view>& known = record_->interface->constants;
    const auto found = std::ranges::find(known, name);
    REFLET_CHECK(found != known.end(), "{} has no specialization constant '{}' (set to {})",
                 record_->interface->shaders.front(), name, value);
    record_->info.constants.emplace_back(*found, value);
}

void Pass::use(const Image& image, const Access& access) {
    // What its owner synchronizes, and what was uploaded once and is only read since.
    if (!image.state->external && image.state->layout != VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL) {
        list_->checkUsable(image);
        addUse(record_->imageUses, image, access);
    }
}

void Pass::use(const BufferView& buffer, const Access& access) {
    list_->checkUsable(buffer);
    addUse(record_->bufferUses, buffer, access);
}

void Pass::checkAccess(const ShaderBinding& binding, const Bound& bound) const {
    const bool wantsBuffer = binding.type == VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
    const bool wantsStructure = binding.type == VK_DESCRIPTOR_TYPE_ACCELERATION_STRUCTURE_KHR;
    const char* wanted = wantsStructure ? "an acceleration structure" : wantsBuffer ? "a buffer" : "an image";
    REFLET_CHECK(static_cast<bool>(bound.buffer) == wantsBuffer && static_cast<bool>(bound.structure) == wantsStructure,
                 "{}: '{}' is {} in the shader", record_->name, binding.name, wanted);
    const bool writable = !binding.readOnly;
    const bool canWrite = binding.type == VK_DESCRIPTOR_TYPE_STORAGE_IMAGE || wantsBuffer;
    REFLET_CHECK(bound.write == (canWrite && writable), "{}: '{}' is {} here, and {} in the shader", record_->name,
                 binding.name, bound.write ? "written" : "read", canWrite && writable ? "not readonly" : "readonly");
    // Elsewhere a mismatch reads garbage, and only newer validation layers report it.
    const bool anyFormat = binding.type != VK_DESCRIPTOR_TYPE_STORAGE_IMAGE || binding.format == VK_FORMAT_UNDEFINED;
    REFLET_CHECK(anyFormat || bound.image.format == binding.format,
                 "{}: '{}' has VkFormat {} here and {} in the shader", record_->name, binding.name,
                 static_cast<int>(bound.image.format), static_cast<int>(binding.format));
}

void Pass::checkBound() const {
    constexpr uint32_t nothing = UINT32_MAX;
    const std::vector<ShaderBinding>& bindings = record_->interface->bindings;
    std::vector<uint32_t>& boundOf = record_->boundOf;
    boundOf.assign(bindings.size(), nothing);
    for (uint32_t i = 0; i < record_->slots.size(); ++i) {
        boundOf[record_->slots[i]] = i;
    }
    for (const PassRecord::Uniform& uniform : record_->uniforms) {
        boundOf[uniform.slot] = uniform.offset;
    }
    for (size_t k = 0; k < bindings.size(); ++k) {
        boundOf[k] = boundOf[record_->interface->sameName[k]];
        const bool block = bindings[k].type == VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER;
        REFLET_CHECK(boundOf[k] != nothing || !block, "{}: the uniform block '{}' is not set", record_->name,
                     bindings[k].name);
        REFLET_CHECK(boundOf[k] != nothing, "{}: nothing is bound to '{}'", record_->name, bindings[k].name);
    }
}

void Pass::append() {
    checkBound();
    list_->append(*record_);
}

void ComputePass::dispatch(uint32_t x, uint32_t y, uint32_t z) {
    const glm::uvec3 local = record_->interface->localSize;
    record_->groups = (glm::uvec3(x, y, z) + local - 1U) / local;
    append();
}

void ComputePass::dispatchIndirect(BufferView arguments, VkDeviceSize offset) {
    use(arguments, {VK_PIPELINE_STAGE_2_DRAW_INDIRECT_BIT, VK_ACCESS_2_INDIRECT_COMMAND_READ_BIT, false});
    record_->arguments = arguments;
    record_->argumentsOffset = offset;
    append();
}

RasterPass& RasterPass::read(Image image) {
    use(image, {VK_PIPELINE_STAGE_2_VERTEX_SHADER_BIT | VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT,
                VK_ACCESS_2_SHADER_READ_BIT, false});
    return *this;
}

RasterPass& RasterPass::color(std::string_view output, Image image, std::optional<VkClearColorValue> clear) {
    const std::vector<ShaderLocation>& outputs = record_->interface->colorOutputs;
    const auto known = std::ranges::find(outputs, output, &ShaderLocation::name);
    REFLET_CHECK(known != outputs.end(), "{}: the shader has no output '{}'", record_->name, output);
    record_->colors.push_back({known->name, image, clear});
    record_->info.colorFormats.push_back(image.format);
    record_->boundBytes += bytesOf(image);
    use(image, colorAccess);
    return *this;
}

RasterPass& RasterPass::depth(Image image, std::optional<float> clear) {
    record_->depth = image;
    record_->clearDepth = clear;
    record_->info.depthFormat = image.format;
    record_->boundBytes += bytesOf(image);
    use(image, depthAccess);
    return *this;
}

RasterPass& RasterPass::blend() {
    record_->info.blends = true;
    return *this;
}

RasterPass& RasterPass::vertices(const VertexLayout& layout, VkDescriptorSetLayout drawSet) {
    record_->info.vertices = &layout;
    record_->info.drawSet = drawSet;
    return *this;
}

// Attachments are declared by the name of the fragment shader's output; the pipeline needs them ordered by location.
void RasterPass::checkTargets() const {
    const std::vector<ShaderLocation>& outputs = record_->interface->colorOutputs;
    REFLET_CHECK(record_->colors.size() == outputs.size(), "{}: {} render targets for {} shader outputs", record_->name,
                 record_->colors.size(), outputs.size());
    for (const ShaderLocation& output : outputs) {
        const auto given = std::ranges::find(record_->colors, output.name, &Attachment::output);
        REFLET_CHECK(given != record_->colors.end(), "{}: no render target for the output '{}'", record_->name,
                     output.name);
        REFLET_CHECK(static_cast<size_t>(given - record_->colors.begin()) == output.location,
                     "{}: the target '{}' is not in the order of its location {}", record_->name, output.name,
                     output.location);
    }
}

void RasterPass::appendDraw() {
    checkTargets();
    for (const BufferView& buffer : list_->drawnBuffers()) {
        use(buffer, {VK_PIPELINE_STAGE_2_VERTEX_ATTRIBUTE_INPUT_BIT, VK_ACCESS_2_VERTEX_ATTRIBUTE_READ_BIT, false});
    }
    append();
}

}  // namespace reflet::gpu
