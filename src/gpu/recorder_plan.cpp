// Turns the list at hand into a plan, or finds the plan that it had before.
#include "gpu/recorder.h"

#include "base/error.h"
#include "gpu/context.h"

#include <algorithm>
#include <string>

namespace reflet::gpu {

namespace {

class Hash {
public:
    void add(uint64_t value) {
        sum_ = (sum_ ^ value) * 0x9E3779B97F4A7C15U;
        sum_ ^= sum_ >> 29U;
    }
    [[nodiscard]] uint64_t sum() const { return sum_; }

private:
    uint64_t sum_ = 0;
};

// Of most of what tells graphs apart; equality compares all.
uint64_t hashOf(const PassGraph& graph, const std::vector<ImageInfo>& infos) {
    Hash hash;
    hash.add(graph.passes.size());
    for (const ResourceUse& use : graph.uses) {
        hash.add(use.resource ^ use.access.access << 8U);
    }
    for (const GraphResource& resource : graph.resources) {
        hash.add(resource.offset ^ resource.size << 20U ^ uint64_t(resource.undefined) ^
                 uint64_t(resource.output) << 1U);
        hash.add(resource.before.writeStages ^ resource.before.readStages << 1U);
        hash.add(resource.before.writeAccess);
    }
    for (const GraphHeap& heap : graph.heaps) {
        hash.add(heap.blocks.size() ^ heap.taken.size() << 32U);
        for (const MemoryRange& taken : heap.taken) {
            hash.add(taken.offset ^ taken.size << 20U);
        }
        for (const HeldRange& held : heap.held) {
            hash.add(held.resource ^ uint64_t(held.use) << 32U);
        }
        hash.add(heap.before.access);
    }
    for (const ImageInfo& info : infos) {
        hash.add(info.size.x ^ uint64_t(info.size.y) << 20U ^ uint64_t(info.format) << 40U);
    }
    return hash.sum();
}

}  // namespace

uint32_t Recorder::listed(const Image& view) {
    ImageState& state = *view.state;
    if (state.mark.list == listNumber() && state.mark.owner == this) {
        return state.mark.index;
    }
    state.mark = {this, listNumber(), static_cast<uint32_t>(resources_.size())};
    resources_.push_back({view, {}});
    GraphResource& resource = graph_.resources.emplace_back();
    ImageInfo& info = infos_.emplace_back();
    resource.image = true;
    TransientImage* transient = state.transient >= 0 ? &transientOf(state) : nullptr;
    if (transient == nullptr || transient->list != listNumber()) {
        resource.undefined = state.layout == VK_IMAGE_LAYOUT_UNDEFINED;
        resource.before = state.access;
        if (state.held != nullptr) {
            resource.held = true;
            resource.heap = state.held->heap;
            resource.offset = state.held->offset;
            resource.size = state.held->size;
            // Others may have been in its memory, also images of another size.
            const HeldImage& held = *state.held;
            const bool begins = held.isNext && held.usedFrame != number_ + 1 && &state == &held.current->state;
            resource.undefined = resource.undefined || begins || held.occupant != state.id;
        }
        return state.mark.index;
    }
    if (transient->needs.size == 0) {
        transient->needs = memory().needsOf(transient->info);
    }
    info = transient->info;
    resource.transient = true;
    resource.output = transient->kept;
    resource.heap = transient->needs.heap;
    resource.size = transient->needs.size;
    resource.alignment = transient->needs.alignment;
    return state.mark.index;
}

uint32_t Recorder::listed(const BufferView& view) {
    BufferState& state = *view.state;
    if (state.mark.list == listNumber() && state.mark.owner == this) {
        return state.mark.index;
    }
    state.mark = {this, listNumber(), static_cast<uint32_t>(resources_.size())};
    resources_.push_back({{}, view});
    GraphResource& resource = graph_.resources.emplace_back();
    infos_.emplace_back();
    TransientBuffer* transient = state.transient >= 0 ? &transientOf(state) : nullptr;
    if (transient == nullptr || transient->list != listNumber()) {
        resource.before = state.access;
        return state.mark.index;
    }
    if (transient->needs.size == 0) {
        transient->needs = memory().needsOf(transient->size);
    }
    resource.transient = true;
    resource.output = transient->kept;
    resource.heap = transient->needs.heap;
    resource.size = transient->needs.size;
    resource.alignment = transient->needs.alignment;
    infos_.back().size = uvec2(transient->size & 0xFFFFFFFFU, transient->size >> 32U);
    return state.mark.index;
}

void Recorder::makeGraph() {
    graph_.passes.clear();
    graph_.uses.clear();
    graph_.resources.clear();
    infos_.clear();
    resources_.clear();
    for (PassRecord* pass : passes()) {
        const auto first = static_cast<uint32_t>(graph_.uses.size());
        for (const auto& [image, access] : pass->imageUses) {
            graph_.uses.push_back({listed(image), access});
        }
        for (const auto& [buffer, access] : pass->bufferUses) {
            graph_.uses.push_back({listed(buffer), access});
        }
        graph_.passes.push_back(
            {first, static_cast<uint32_t>(graph_.uses.size()) - first, pass->root || pass->kind == PassKind::readback});
    }
    graph_.heaps = memory().heaps();
    memory().describeHeld(graph_.heaps, number_, [&](const ImageState& state) {
        const bool listed = state.mark.owner == this && state.mark.list == listNumber();
        return listed ? state.mark.index : HeldRange::unused;
    });
}

Recorder::CachedPlan& Recorder::planned() {
    const auto [first, last] = plans_.equal_range(hashOf(graph_, infos_));
    for (auto known = first; known != last; ++known) {
        if (known->second->infos == infos_ && known->second->graph == graph_) {
            known->second->lastUse = number_;
            return *known->second;
        }
    }
    ++counting_.plans;
    auto made = std::make_unique<CachedPlan>();
    made->graph = graph_;
    made->infos = infos_;
    made->plan = compile(graph_);
    made->lastUse = number_;
    place(*made);
    const uint64_t hash = hashOf(made->graph, made->infos);  // place() has changed its blocks
    return *plans_.emplace(hash, std::move(made))->second;
}

void Recorder::place(CachedPlan& cached) {
    memory().reserve(cached.plan.ends);
    for (size_t heap = 0; heap < cached.graph.heaps.size();
         ++heap) {  // with the new blocks, as the next frame has them
        cached.graph.heaps[heap].blocks = memory().heaps()[heap].blocks;
    }
    cached.images.resize(resources_.size());
    cached.buffers.resize(resources_.size());
    for (size_t r = 0; r < resources_.size(); ++r) {
        const VkDeviceSize offset = cached.plan.offsets[r];
        if (offset == Plan::unplaced) {
            continue;
        }
        if (resources_[r].image) {
            const TransientImage& image = transientOf(*resources_[r].image.state);
            cached.images[r] = memory().image(image.info, offset, std::string(image.name));
        } else {
            cached.buffers[r] = memory().buffer(transientOf(*resources_[r].buffer.state).size, offset);
        }
    }
}

void Recorder::addToListing(const CachedPlan& cached) {
    const Plan& plan = cached.plan;
    const auto firstPass = static_cast<int>(listing_.passes.size());
    std::vector<std::string> names;
    for (size_t r = 0; r < resources_.size(); ++r) {
        PassListing::Resource& shown = listing_.resources.emplace_back();
        const Listed& of = resources_[r];
        const GraphResource& resource = cached.graph.resources[r];
        shown.bytes = resource.transient ? resource.size : of.image ? of.image.state->bytes : of.buffer.state->bytes;
        if (of.image) {
            shown.name =
                of.image.state->transient >= 0 ? std::string(transientOf(*of.image.state).name) : of.image.state->name;
            shown.format = formatName(of.image.format);
            shown.size = of.image.size;
        } else {
            shown.name = of.buffer.state->transient >= 0 ? std::string(transientOf(*of.buffer.state).name)
                                                         : of.buffer.state->name;
        }
        names.push_back(shown.name);
        if (resource.transient && plan.offsets[r] != Plan::unplaced) {
            shown.first = firstPass + static_cast<int>(plan.lifetimes[r].first);
            shown.last = firstPass + static_cast<int>(std::min<size_t>(plan.lifetimes[r].last, plan.order.size() - 1));
            shown.offset = plan.offsets[r];
        }
    }
    for (size_t i = 0; i < plan.order.size(); ++i) {
        const PassRecord& pass = *passes()[plan.order[i]];
        PassListing::Pass& shown = listing_.passes.emplace_back();
        shown.name = pass.name;
        shown.raster = pass.kind == PassKind::raster;
        shown.bytes = pass.boundBytes;
        shown.level = plan.levels[i];
        const GraphPass& uses = cached.graph.passes[plan.order[i]];
        for (uint32_t u = uses.firstUse; u < uses.firstUse + uses.useCount; ++u) {
            const ResourceUse& use = cached.graph.uses[u];
            (use.access.write ? shown.writes : shown.reads).push_back(names[use.resource]);
        }
    }
}

}  // namespace reflet::gpu
