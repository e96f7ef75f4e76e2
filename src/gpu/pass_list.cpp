// Collects the passes of a frame.
#include "gpu/pass_list.h"

#include "base/error.h"
#include "gpu/context.h"

#include <algorithm>
#include <cstring>

namespace reflet::gpu {

namespace {

constexpr Access transferRead{VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, VK_ACCESS_2_TRANSFER_READ_BIT, false};
constexpr Access transferWrite{VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT, true};

}  // namespace

PassList::Named& PassList::named(std::string_view name) {
    fullName_ = prefix_;
    fullName_ += name;
    if (const auto known = byName_.find(fullName_); known != byName_.end()) {
        return *known->second;
    }
    auto made = std::make_unique<Named>();
    made->name = fullName_;
    made->index = static_cast<uint32_t>(names_.size());
    Named& named = *names_.emplace_back(std::move(made));
    byName_.emplace(named.name, &named);
    return named;
}

PassRecord& PassList::record(std::string_view name, PassKind kind) {
    REFLET_CHECK(open_, "{}: no frame has begun", name);
    Named& of = named(name);
    of.used = of.frame == frame_ ? of.used : 0;
    of.frame = frame_;
    if (of.used == of.records.size()) {
        of.records.push_back(std::make_unique<PassRecord>());
    }
    PassRecord& record = *of.records[of.used++];
    record.clearDeclarations();
    record.name = of.name;
    record.nameIndex = of.index;
    record.kind = kind;
    return record;
}

PassRecord& PassList::shaderRecord(std::string_view name, PassKind kind, std::span<const std::string_view> shaders) {
    PassRecord& made = record(name, kind);
    PipelineCache& pipelines = context_.pipelines();
    const bool known = made.interface != nullptr && made.pipelinesVersion == pipelines.version() &&
                       std::ranges::equal(made.interface->shaders, shaders);
    if (!known) {
        made.interface = &pipelines.interfaceOf(shaders);
        made.pipeline = nullptr;
        made.pipelinesVersion = pipelines.version();
    }
    made.info.shaders.assign(made.interface->shaders.begin(), made.interface->shaders.end());
    return made;
}

ComputePass PassList::compute(std::string_view name, std::string_view shader) {
    return {*this, shaderRecord(name, PassKind::compute, {&shader, 1})};
}

RasterPass PassList::raster(std::string_view name, std::initializer_list<std::string_view> shaders) {
    return {*this, shaderRecord(name, PassKind::raster, {shaders.begin(), shaders.size()})};
}

void PassList::appendTransfer(PassRecord& record) {
    for (const auto& [image, access] : record.imageUses) {
        checkUsable(image);
    }
    for (const auto& [buffer, access] : record.bufferUses) {
        checkUsable(buffer);
    }
    append(record);
}

void PassList::update(BufferView buffer, std::span<const std::byte> bytes) {
    REFLET_CHECK(bytes.size() <= buffer.size && bytes.size() % 4 == 0, "{} bytes", bytes.size());
    PassRecord& made = record("update", PassKind::update);
    made.bytes.assign(bytes.begin(), bytes.end());
    made.buffer = buffer;
    made.bufferUses.emplace_back(buffer, transferWrite);
    appendTransfer(made);
}

void PassList::clear(Image image, const VkClearColorValue& value) {
    PassRecord& made = record("clear", PassKind::clear);
    made.to = image;
    made.clear = value;
    made.imageUses.emplace_back(image, transferWrite);
    appendTransfer(made);
}

void PassList::upload(Image image, std::span<const std::byte> texels) {
    REFLET_CHECK(texels.size() == size_t(image.size.x) * image.size.y * bytesPerTexel(image.format),
                 "{} bytes for {}x{}", texels.size(), image.size.x, image.size.y);
    PassRecord& made = record("upload", PassKind::upload);
    made.staging = std::make_unique<Buffer>(context_, texels.size(), VK_BUFFER_USAGE_TRANSFER_SRC_BIT,
                                            MemoryUse::upload, "staging");
    std::memcpy(made.staging->bytes().data(), texels.data(), texels.size());
    made.to = image;
    made.imageUses.emplace_back(image, transferWrite);
    appendTransfer(made);
}

void PassList::copy(Image from, Image to) {
    REFLET_CHECK(from.format == to.format && from.size == to.size, "a copy between images of different kinds");
    PassRecord& made = record("copy", PassKind::copy);
    made.from = from;
    made.to = to;
    made.imageUses.emplace_back(from, transferRead);
    made.imageUses.emplace_back(to, transferWrite);
    appendTransfer(made);
}

Readback PassList::readback(Image image) {
    PassRecord& made = record("readback", PassKind::readback);
    made.from = image;
    made.readback = readbacks_++;
    made.imageUses.emplace_back(image, transferRead);
    appendTransfer(made);
    return {made.readback};
}

Image PassList::transientImage(std::string_view name, const ImageInfo& info) {
    REFLET_CHECK(open_, "{}: no frame has begun", name);
    if (imagesUsed_ == images_.size()) {
        images_.emplace_back();
        images_.back().state.transient = static_cast<int32_t>(imagesUsed_);
    }
    TransientImage& made = images_[imagesUsed_++];
    if (made.info != info) {
        made.info = info;
        made.needs = {};
    }
    made.name = named(name).name;
    made.list = list_;
    made.kept = false;
    ImageState& state = made.state;
    state.image = VK_NULL_HANDLE;
    state.view = VK_NULL_HANDLE;
    state.aspect = aspectOf(info.format);
    state.layout = VK_IMAGE_LAYOUT_UNDEFINED;
    state.access = {};
    return {&state, -1, info.format, info.size, info.layers, info.mips};
}

Image PassList::image(std::string_view name, VkFormat format, uvec2 size, uint32_t layers, bool array) {
    return transientImage(name, storageInfo(format, size, layers, array));
}

Image PassList::target(std::string_view name, VkFormat format, uvec2 size) {
    return transientImage(name, targetInfo(format, size));
}

BufferView PassList::buffer(std::string_view name, VkDeviceSize size) {
    REFLET_CHECK(open_, "{}: no frame has begun", name);
    if (buffersUsed_ == buffers_.size()) {
        buffers_.emplace_back();
        buffers_.back().state.transient = static_cast<int32_t>(buffersUsed_);
    }
    TransientBuffer& made = buffers_[buffersUsed_++];
    if (made.size != size) {
        made.size = size;
        made.needs = {};
    }
    made.name = named(name).name;
    made.list = list_;
    made.kept = false;
    made.state.buffer = VK_NULL_HANDLE;
    made.state.access = {};
    return {&made.state, size};
}

void PassList::keep(Image image) {
    if (image && image.state->transient >= 0) {
        checkUsable(image);
        transientOf(*image.state).kept = true;
    }
}

void PassList::keep(BufferView buffer) {
    if (buffer && buffer.state->transient >= 0) {
        checkUsable(buffer);
        transientOf(*buffer.state).kept = true;
    }
}

bool PassList::isKept(Image image) const {
    if (!image || image.state->transient < 0) {
        return false;
    }
    const TransientImage& of = images_[static_cast<size_t>(image.state->transient)];
    return of.kept && of.list != list_ && image.state->image != VK_NULL_HANDLE;
}

void PassList::release(Image image) {
    if (!image || image.state->transient < 0) {
        return;
    }
    TransientImage& of = transientOf(*image.state);
    if (of.kept && of.list != list_) {
        freePlace(of.needs, of.offset);
        of.kept = false;
    }
}

void PassList::release(BufferView buffer) {
    if (!buffer || buffer.state->transient < 0) {
        return;
    }
    TransientBuffer& of = transientOf(*buffer.state);
    if (of.kept && of.list != list_) {
        freePlace(of.needs, of.offset);
        of.kept = false;
    }
}

void PassList::freePlace(const TransientMemory::Needs& needs, VkDeviceSize offset) {
    std::erase(memory_.heaps()[needs.heap].taken, MemoryRange{offset, needs.size});
}

void PassList::checkUsable(const Image& image) const {
    if (image.state->transient >= 0) {
        const TransientImage& of = images_[static_cast<size_t>(image.state->transient)];
        REFLET_CHECK(of.list == list_ || (of.kept && image.state->image != VK_NULL_HANDLE),
                     "the image '{}' lived in an earlier list; PassList::keep keeps it", of.name);
    }
}

void PassList::checkUsable(const BufferView& buffer) const {
    if (buffer.state->transient >= 0) {
        const TransientBuffer& of = buffers_[static_cast<size_t>(buffer.state->transient)];
        REFLET_CHECK(of.list == list_ || (of.kept && buffer.state->buffer != VK_NULL_HANDLE),
                     "the buffer '{}' lived in an earlier list; PassList::keep keeps it", of.name);
    }
}

Image PassList::placeholder(VkFormat format, ViewKind view) {
    Texture& texture = placeholders_[{format, view}];
    if (texture.info().size.x == 0) {
        const VkImageUsageFlags usage = VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_SAMPLED_BIT;
        const uint32_t layers = view == ViewKind::cube || view == ViewKind::cubeArray ? 6 : 1;
        const ImageInfo info{format, uvec2(1), 1, layers, usage, view};
        texture = Texture(context_, info, "placeholder");
        texture.image().state->unused = true;
    }
    return texture.image();
}

Image PassList::unusedTarget(const Image& placeholder) {
    const auto like = std::ranges::find_if(
        placeholders_, [&](const auto& entry) { return entry.second.image().state == placeholder.state; });
    return transientImage("unused", like->second.info());
}

bool PassList::isDiscarded(uint64_t list) const {
    return std::ranges::binary_search(discarded_, list);
}

void PassList::clearFrame() {
    nextList(false);
    ++frame_;
    imagesUsed_ = 0;
    buffersUsed_ = 0;
    readbacks_ = 0;
    drawnBuffers_.clear();
    prefix_.clear();
}

void PassList::nextList(bool recorded) {
    if (!recorded && promised_) {
        discarded_.push_back(list_);
    }
    promised_ = false;
    for (PassRecord* pass : passes_) {
        pass->draw.reset();
        pass->staging.reset();
    }
    passes_.clear();
    ++list_;
}

PassList::Scope::Scope(PassList& list, std::string_view prefix) : list_(list), before_(list.prefix_.size()) {
    list.prefix_ += prefix;
    list.prefix_ += '.';
}

PassList::Scope::~Scope() {
    list_.prefix_.resize(before_);
}

}  // namespace reflet::gpu
