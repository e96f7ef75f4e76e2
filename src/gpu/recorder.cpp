// Plans and records the passes of a frame.
#include "gpu/recorder.h"

#include "base/error.h"
#include "gpu/context.h"

#include <algorithm>
#include <exception>

namespace reflet::gpu {

namespace {

// Frames for which a plan stays that is not used. Of frames that change their size, which come back to what they had
// much later, as many stay as a host makes that changes all it can; one takes 10 KB, and images without memory.
constexpr uint64_t planFrames = 8;
constexpr uint64_t sizedPlanFrames = 32;
constexpr size_t mostSizedPlans = 2048;
// Frames in a row that need less than half of the memory before it is given back.
constexpr uint32_t mostRoomyFrames = 16;

}  // namespace

// The other constructor first, so that the destructor runs if something fails here.
Recorder::Recorder(Context& context, bool timesPasses, WithoutSlots /*tag*/)
    : PassList(context), sets_(context), timers_(context, timesPasses) {
    orderPasses(context.isCpu() ? PassOrder::asListed : PassOrder::byLevel);
}

Recorder::Recorder(Context& context, uint32_t framesInFlight, bool timesPasses)
    : Recorder(context, timesPasses, WithoutSlots{}) {
    REFLET_CHECK(framesInFlight >= 1 && framesInFlight <= maxFramesInFlight, "{} frames in flight", framesInFlight);
    slots_.resize(framesInFlight);
    for (Slot& slot : slots_) {
        slot.uniforms.push_back(makeUniforms());
        timers_.makePool(slot.timed);
    }
}

Recorder::~Recorder() {
    abandon();
    for (Slot& slot : slots_) {
        timers_.destroy(slot.timed);
    }
}

void Recorder::start() {
    clearFrame();
    open_ = true;
    listsOfFrame_ = 0;
    counting_ = {};
    listing_ = {};
    began_ = std::chrono::steady_clock::now();
    for (GraphHeap& heap : memory().heaps()) {
        heap.taken.clear();
    }
    if (tidies_ || memory().isUntidy()) {
        plans_.clear();
        memory().release();
        tidies_ = false;
    }
}

void Recorder::begin(VkCommandBuffer commands) {
    ++number_;
    finish(slot());
    Slot& now = slot();
    if (now.uniforms.size() > now.uniformBlock + 1) {
        now.uniforms.resize(now.uniformBlock + 1);  // what the last frame needed
    }
    now.uniformBlock = 0;
    now.uniformsUsed = 0;
    now.serial = context().beginWork();
    start();
    commands_ = commands;
    timers_.reset(now.timed, commands);
}

void Recorder::prepare(std::vector<PipelineInfo>& missing) {
    preparation_ = context().beginWork();
    start();
    missing_ = &missing;
}

void Recorder::end() {
    if (open_) {
        flush();
        dropUnused();
        counting_.ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - began_).count();
        counted_ = counting_;
    }
    open_ = false;
    commands_ = VK_NULL_HANDLE;
    missing_ = nullptr;
    if (preparation_ != 0) {
        context().finishWork(preparation_);
        preparation_ = 0;
    }
}

// Of a lost device all frames are finished, though none can be read.
void Recorder::finish() {
    std::exception_ptr failure;
    for (uint64_t i = 1; i <= slots_.size(); ++i) {  // from the oldest
        try {
            finish(slots_[(number_ + i) % slots_.size()]);
        } catch (const Error&) {
            failure = std::current_exception();
        }
    }
    if (failure) {
        std::rethrow_exception(failure);
    }
}

void Recorder::abandon() noexcept {
    for (Slot& slot : slots_) {
        if (slot.serial != 0) {
            context().finishWork(slot.serial);
            slot.serial = 0;
        }
    }
}

void Recorder::finish(Slot& slot) {
    if (slot.serial == 0) {
        return;
    }
    context().finishWork(slot.serial);
    slot.serial = 0;
    timers_.read(slot.timed, times_);
    finished_ = static_cast<size_t>(&slot - slots_.data());
}

std::span<const std::byte> Recorder::bytes(Readback readback) const {
    return slots_[finished_].readbacks.at(readback.index).bytes();
}

void Recorder::applyPlaces(const CachedPlan& cached) {
    for (size_t r = 0; r < resources_.size(); ++r) {
        if (cached.images[r]) {
            ImageState& state = *resources_[r].image.state;
            const ImageState& placed = cached.images[r]->state;
            state.image = placed.image;
            state.view = placed.view;
            state.id = placed.id;
        } else if (cached.buffers[r]) {
            BufferState& state = *resources_[r].buffer.state;
            state.buffer = cached.buffers[r]->state.buffer;
            state.id = cached.buffers[r]->state.id;
        }
        if (resources_[r].image && cached.plan.lifetimes[r].first != UINT32_MAX) {
            resources_[r].image.state->layout = VK_IMAGE_LAYOUT_GENERAL;
        }
    }
}

// Some of the passes were recorded, and a host may submit them: what comes next waits for everything.
void Recorder::noteFailure(const CachedPlan& cached) {
    const AccessState unknown{VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, VK_ACCESS_2_MEMORY_WRITE_BIT, 0, 0, 0};
    for (size_t r = 0; r < resources_.size(); ++r) {
        const Listed& of = resources_[r];
        (of.image ? of.image.state->access : of.buffer.state->access) = unknown;
        if (cached.graph.resources[r].undefined) {
            of.image.state->layout = VK_IMAGE_LAYOUT_UNDEFINED;
        }
    }
    for (GraphHeap& heap : memory().heaps()) {
        heap.before = {unknown.writeStages, unknown.writeAccess, true};
    }
}

// What is only prepared stays without a layout.
void Recorder::noteLayouts(const CachedPlan& cached) {
    for (size_t r = 0; r < resources_.size() && missing_ != nullptr; ++r) {
        if (cached.graph.resources[r].undefined) {
            resources_[r].image.state->layout = VK_IMAGE_LAYOUT_UNDEFINED;
        }
    }
}

void Recorder::makePipelines(const Plan& plan) {
    PipelineCache& pipelines = context().pipelines();
    std::vector<PipelineInfo> found;
    std::vector<PipelineInfo>& missing = missing_ != nullptr ? *missing_ : found;
    const auto eachWithout = [&](const auto& handle) {
        for (const uint32_t i : plan.order) {
            PassRecord& pass = *passes()[i];
            if ((pass.kind == PassKind::compute || pass.kind == PassKind::raster) &&
                (pass.pipeline == nullptr || !(pass.madeInfo == pass.info))) {
                handle(pass);
            }
        }
    };
    eachWithout([&](const PassRecord& pass) {
        if (!pipelines.has(pass.info) && std::ranges::find(missing, pass.info) == missing.end()) {
            missing.push_back(pass.info);
        }
    });
    if (missing_ != nullptr) {
        return;
    }
    if (!found.empty()) {
        pipelines.make(found);
    }
    eachWithout([&](PassRecord& pass) {
        pass.pipeline = &pipelines.get(pass.info);
        pass.madeInfo = pass.info;
    });
}

void Recorder::flush() {
    if (passes().empty()) {
        return;
    }
    makeGraph();
    const CachedPlan& cached = planned();
    makePipelines(cached.plan);
    applyPlaces(cached);
    if (missing_ == nullptr) {
        try {
            record(cached);
        } catch (...) {
            noteFailure(cached);
            throw;
        }
        noteAfter(cached);
        if (lists_) {
            addToListing(cached);
        }
    }
    noteLayouts(cached);
    for (size_t r = 0; r < resources_.size(); ++r) {
        const GraphResource& resource = cached.graph.resources[r];
        if (resource.output && cached.plan.offsets[r] != Plan::unplaced) {
            memory().heaps()[resource.heap].taken.push_back({cached.plan.offsets[r], resource.size});
            VkDeviceSize& offset = resources_[r].image ? transientOf(*resources_[r].image.state).offset
                                                       : transientOf(*resources_[r].buffer.state).offset;
            offset = cached.plan.offsets[r];
        }
    }
    for (const Listed& of : resources_) {
        HeldImage* const held = of.image ? of.image.state->held : nullptr;
        if (held != nullptr && of.image.state == &held->current->state) {  // not what was only resampled
            held->usedFrame = number_ + 1;
            if (missing_ == nullptr) {
                held->recordedFrame = number_ + 1;
                held->occupant = of.image.state->id;
            }
        }
    }
    ++listsOfFrame_;
    nextList(missing_ == nullptr);
}

void Recorder::noteAfter(const CachedPlan& cached) {
    for (size_t r = 0; r < resources_.size(); ++r) {
        if (cached.plan.lifetimes[r].first == UINT32_MAX) {
            continue;
        }
        const AccessState& after = cached.plan.after[r];
        const Listed& of = resources_[r];
        (of.image ? of.image.state->access : of.buffer.state->access) = after;
        if (of.image && of.image.state->held != nullptr) {
            Access& before = memory().heaps()[of.image.state->held->heap].before;
            before = merged(before, {after.writeStages | after.readStages, after.writeAccess, after.writeAccess != 0});
        }
        const int32_t transient = of.image ? of.image.state->transient : of.buffer.state->transient;
        if (transient >= 0) {  // whoever gets its memory waits for this
            const uint32_t heap =
                of.image ? transientOf(*of.image.state).needs.heap : transientOf(*of.buffer.state).needs.heap;
            Access& before = memory().heaps()[heap].before;
            before = merged(before, {after.writeStages | after.readStages, after.writeAccess, after.writeAccess != 0});
        }
    }
}

// Those that have not been used for longest.
void Recorder::dropPlans() {
    if (sizes().rescale == nullptr) {
        std::erase_if(plans_, [&](const auto& cached) { return cached.second->lastUse + planFrames < number_; });
    } else if (plans_.size() > mostSizedPlans) {
        std::vector<uint64_t> uses;
        for (const auto& [hash, cached] : plans_) {
            uses.push_back(cached->lastUse);
        }
        const auto limit = uses.begin() + static_cast<std::ptrdiff_t>(uses.size() - mostSizedPlans * 3 / 4);
        std::ranges::nth_element(uses, limit);
        std::erase_if(plans_, [&, oldest = *limit](const auto& cached) {
            return cached.second->lastUse < oldest && cached.second->lastUse + sizedPlanFrames < number_;
        });
    }
}

// Plans that have not been used for a while, and memory that is scattered or much too large. Where one list makes a
// frame, its memory is one block of the right size from the third frame on.
void Recorder::dropUnused() {
    dropPlans();
    if (listsOfFrame_ != 1 || missing_ != nullptr) {
        roomyFrames_ = 0;
        return;
    }
    VkDeviceSize used = 0;
    for (const auto& [hash, cached] : plans_) {
        if (cached->lastUse + sizedPlanFrames < number_) {
            continue;
        }
        VkDeviceSize sum = 0;
        for (const VkDeviceSize end : cached->plan.ends) {
            sum += end;
        }
        used = std::max(used, sum);
    }
    const VkDeviceSize beside = used > memory().heldBytes() ? used - memory().heldBytes() : 0;
    roomyFrames_ = 2 * beside < memory().bytes() ? roomyFrames_ + 1 : 0;
    tidies_ = roomyFrames_ > mostRoomyFrames || (memory().blockCount() > 1 && counting_.plans > 0);
}

}  // namespace reflet::gpu
