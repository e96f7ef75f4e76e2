// Views of the C API: their life, and the start and end of a frame.
#include "api/calls.h"
#include "api/camera.h"
#include "api/frame.h"
#include "api/live.h"
#include "lighting/jitter.h"

#include <algorithm>

namespace reflet::api {

namespace {

constexpr uint32_t largestSide = maxFrameSize;

void checkSize(uint32_t width, uint32_t height) {
    if (width < 1 || height < 1 || width > largestSide || height > largestSide) {
        failArgument("width, height: are {}x{}; both must be 1 to {}", width, height, largestSide);
    }
}

// The next frame's writes wait for whatever the host's commands read of the last one's results.
void waitForReaders(RefletView_T& view) {
    VkMemoryBarrier2 barrier{VK_STRUCTURE_TYPE_MEMORY_BARRIER_2};
    barrier.srcStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
    barrier.dstStageMask = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT | VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT;
    VkDependencyInfo info{VK_STRUCTURE_TYPE_DEPENDENCY_INFO};
    info.memoryBarrierCount = 1;
    info.pMemoryBarriers = &barrier;
    view.owner.gpu->vk.vkCmdPipelineBarrier2(view.commands, &info);
}

// What the host has drawn of this frame.
Rectangle rectangleOf(const RefletView_T& view, const RefletFrameInfo& info) {
    const uvec2 given(info.renderSize[0], info.renderSize[1]);
    if (given == uvec2(0)) {
        return {view.size, false};
    }
    if (given.x < 1 || given.y < 1 || given.x > view.size.x || given.y > view.size.y) {
        failArgument(
            "RefletFrameInfo.renderSize: is {}x{}; must be 1x1 to the view's size, {}x{} (refletCreateView), or 0x0",
            given.x, given.y, view.size.x, view.size.y);
    }
    return {given, true};
}

// Frames of this size in a row before one of it that begins now.
uint32_t steadyFramesBefore(const RefletView_T& view, uvec2 size) {
    return size == view.renderSize ? std::min(view.steadyFrames, UINT32_MAX - 1) + 1 : 0;
}

// Makes it the size of the frame that begins.
void startSize(RefletView_T& view, uvec2 size) {
    const uvec2 before = view.renderSize;
    view.steadyFrames = steadyFramesBefore(view, size);
    view.renderSize = size;
    view.recorder.setSizes(sizesOf(view, before));
}

float preExposureOf(const RefletFrameInfo& info) {
    constexpr float least = 1e-8F;
    constexpr float most = 1e8F;
    if (info.preExposure != 0.0F && !(info.preExposure >= least && info.preExposure <= most)) {
        failArgument("RefletFrameInfo.preExposure: is {}; must be {} to {}, or 0 for 1", info.preExposure, least, most);
    }
    return info.preExposure != 0.0F ? info.preExposure : 1.0F;
}

Frame frameOf(const RefletView_T& view, const RefletFrameInfo& info, const RefletGBuffer& gbuffer,
              const Rectangle& drawn) {
    Frame frame;
    frame.context.view = viewParams(info, gbuffer.depthKind, drawn.size, view.renderSize);
    frame.context.view.seed = view.seed;
    frame.jitter = {info.jitter[0], info.jitter[1]};
    if (!(info.elapsed >= 0.0F && info.elapsed <= 3600.0F)) {
        failArgument("RefletFrameInfo.elapsed: is {}; must be 0 to 3600 seconds", info.elapsed);
    }
    frame.elapsed = info.elapsed;
    frame.preExposure = preExposureOf(info);
    frame.context.view.exposureChange = frame.preExposure / view.preExposure;
    if (!(info.lightChange >= 0.0F && info.lightChange <= 1.0F)) {
        failArgument("RefletFrameInfo.lightChange: is {}; must be 0 to 1", info.lightChange);
    }
    // Another size changes the picture, and so does another environment.
    frame.context.view.rest =
        std::min({info.restFrames, steadyFramesBefore(view, drawn.size), view.store->environmentRests++});
    frame.change = {frame.context.view.rest, info.lightChange};
    // In the first frame nobody knows whether the host will composite.
    const bool first = view.store->lastGeneration != view.recorder.generation();
    frame.context.composes = first || view.composedLast;
    frame.showsEnvironment = info.backgroundIsEnvironment != 0;
    frame.size = drawn.size;
    frame.inLarger = drawn.inLarger;
    return frame;
}

// For refletDescribe.
void note(RefletView_T& view, const RefletFrameInfo& info, const RefletGBuffer& gbuffer) {
    Described now{info, gbuffer, outputSizeOf(view)};
    if (view.described) {
        const RefletFrameInfo& before = view.described->info;
        now.frames = view.described->frames + 1;
        now.lastIndex = before.frameIndex;
        now.lastPreExposure = before.preExposure != 0.0F ? before.preExposure : 1.0F;
        now.lastJitter = {before.jitter[0], before.jitter[1]};
    }
    view.described = now;
}

}  // namespace

void checkDevice(const RefletContext_T& context) {
    if (context.gpu->isLost()) {
        failWith(REFLET_ERROR_VULKAN,
                 "the device was lost: destroy the views, the context and the device, and make all of them anew");
    }
}

Settings settingsOfFrame(const RefletView_T& view, const Settings& settings, const lighting::Change& change) {
    Settings ofFrame = settings;
    const auto height = static_cast<float>(view.renderSize.y);
    const auto outputHeight = static_cast<float>(outputSizeOf(view).y);
    lighting::countRenderedPixels(ofFrame, height, outputHeight);
    lighting::fitHistories(ofFrame, change, height / outputHeight);
    ofFrame.traceScreen.countSteps = 0;  // nobody can look at them
    return ofFrame;
}

RefletResult onView(RefletView view, const std::function<void()>& body) {
    void (*log)(void*, RefletResult, const char*) = nullptr;
    void* logUser = nullptr;
    // Nothing is held while the host is told: it may destroy the view.
    std::string note;
    const RefletResult result = guarded([&] {
        const std::shared_ptr<RefletView_T> object = held(view, "view");
        log = object->owner.log;
        logUser = object->owner.logUser;
        const std::scoped_lock lock(object->mutex);
        if (object->destroyed) {  // while this call waited
            failArgument("view: has been destroyed");
        }
        gpu::Memory::setAccount(object->memory);
        try {
            body();
        } catch (...) {
            gpu::Memory::setAccount(nullptr);
            throw;
        }
        gpu::Memory::setAccount(nullptr);
        note = std::exchange(object->note, {});
    });
    if (result != REFLET_SUCCESS && log != nullptr) {
        log(logUser, result, lastError().c_str());
    } else if (!note.empty() && log != nullptr) {
        log(logUser, result, note.c_str());
    }
    return result;
}

RefletResult inFrame(RefletView view, RefletSettings settings,
                     const std::function<void(Frame&, const Settings&)>& body) {
    return onView(view, [&] {
        const std::shared_ptr<RefletSettings_T> given = held(settings, "settings");
        checkDevice(view->owner);
        if (!view->frame) {
            failArgument("view: no frame has begun; call refletBeginFrame first");
        }
        Frame before = *view->frame;
        try {
            body(*view->frame, settingsOfFrame(*view, given->values, view->frame->change));
        } catch (...) {
            view->recorder.drop();
            before.light = view->recorder.isKept(before.light) ? before.light : gpu::Image{};
            *view->frame = before;  // nothing that this call would have made exists
            throw;
        }
    });
}

}  // namespace reflet::api

using namespace reflet;
using namespace reflet::api;

RefletResult refletCreateView(RefletContext context, const RefletViewInfo* info, RefletView* view) {
    if (view != nullptr) {
        *view = nullptr;
    }
    return guarded([&] {
        const std::shared_ptr<RefletContext_T> owner = held(context, "context");
        if (view == nullptr) {
            failArgument("view: is NULL");
        }
        checkDevice(*context);
        const RefletViewInfo given = adopted(info, "RefletViewInfo");
        checkSize(given.width, given.height);
        if (given.framesInFlight < 1 || given.framesInFlight > REFLET_MAX_FRAMES_IN_FLIGHT) {
            failArgument("RefletViewInfo.framesInFlight: is {}; must be 1 to {}", given.framesInFlight,
                         REFLET_MAX_FRAMES_IN_FLIGHT);
        }
        constexpr uint32_t knownFlags = REFLET_VIEW_PASS_TIMES;
        if ((given.flags & ~knownFlags) != 0) {
            failArgument("RefletViewInfo.flags: is {:#x}; must be a combination of RefletViewFlags", given.flags);
        }
        if (given.viewIndex >= REFLET_MAX_VIEW_INDEX) {
            failArgument("RefletViewInfo.viewIndex: is {}; must be 0 to {}", given.viewIndex,
                         REFLET_MAX_VIEW_INDEX - 1);
        }
        const std::scoped_lock lock(context->mutex);
        if (context->destroyed) {
            failArgument("context: has been destroyed");
        }
        auto made =
            std::make_shared<RefletView_T>(*context, given.framesInFlight, (given.flags & REFLET_VIEW_PASS_TIMES) != 0);
        made->seed = given.viewIndex;
        made->size = made->renderSize = {given.width, given.height};
        made->store = std::make_unique<ViewStore>();
        made->keeps = owner;
        Live<RefletView_T>::add(made);
        ++context->owned;
        *view = made.get();
    });
}

void refletDestroyView(RefletView view) {
    std::shared_ptr<RefletView_T> taken = Live<RefletView_T>::take(view);
    if (!taken) {  // NULL, or destroyed before
        return;
    }
    {
        const std::scoped_lock lock(taken->mutex);
        taken->destroyed = true;
        taken->recorder.abandon();
    }
    waitForCalls(taken);
    const std::shared_ptr<RefletContext_T> context = taken->keeps;
    taken.reset();
    const std::scoped_lock lock(context->mutex);
    --context->owned;
}

RefletResult refletResizeView(RefletView view, uint32_t width, uint32_t height) {
    return onView(view, [&] {
        if (view->frame) {
            failArgument("view: a frame has begun; resize before refletBeginFrame or after refletEndFrame");
        }
        checkSize(width, height);
        if (view->size != uvec2(width, height)) {
            view->size = view->renderSize = {width, height};
            view->steadyFrames = UINT32_MAX;
            view->last.reset();
            auto fresh = std::make_unique<ViewStore>();  // the rest is of the old size
            std::swap(fresh->blueNoise, view->store->blueNoise);
            std::swap(fresh->ggxTable, view->store->ggxTable);
            std::swap(fresh->environment, view->store->environment);
            std::swap(fresh->probes, view->store->probes);
            view->store = std::move(fresh);
        }
    });
}

RefletResult refletSetOutputSize(RefletView view, uint32_t width, uint32_t height) {
    return onView(view, [&] {
        if (view->frame) {
            failArgument(
                "view: a frame has begun; set its output size before refletBeginFrame or after refletEndFrame");
        }
        if (width != 0 || height != 0) {
            checkSize(width, height);
        }
        view->outputSize = {width, height};
    });
}

RefletResult refletResetView(RefletView view) {
    return onView(view, [&] {
        if (view->frame) {
            failArgument("view: a frame has begun; reset it before refletBeginFrame or after refletEndFrame");
        }
        EnvironmentImages& environment = view->store->environment;
        const bool current = environment.generation == view->recorder.generation();
        view->recorder.forget();
        if (current) {  // it has no history
            environment.generation = view->recorder.generation();
        }
        view->composedLast = false;
    });
}

RefletResult refletFinishView(RefletView view) {
    return onView(view, [&] {
        if (view->frame) {
            failArgument("view: a frame has begun and not ended, so the device cannot have finished it");
        }
        view->recorder.finish();
    });
}

RefletResult refletViewMemory(RefletView view, uint64_t* bytes) {
    return onView(view, [&] {
        if (bytes == nullptr) {
            failArgument("bytes: is NULL");
        }
        *bytes = view->owner.gpu->memory().read(view->memory);
    });
}

void refletJitter(uint32_t frameIndex, float jitter[2]) {
    if (jitter != nullptr) {
        const vec2 at = subpixelJitter(frameIndex);
        jitter[0] = at.x;
        jitter[1] = at.y;
    }
}

RefletResult refletBeginFrame(RefletView view, const RefletFrameInfo* info) {
    return onView(view, [&] {
        checkDevice(view->owner);
        const RefletFrameInfo given = adopted(info, "RefletFrameInfo", offsetof(RefletFrameInfo, renderSize));
        if (view->frame) {
            failArgument("view: a frame has begun already; call refletEndFrame first");
        }
        if (given.commandBuffer == VK_NULL_HANDLE) {
            failArgument("RefletFrameInfo.commandBuffer: is VK_NULL_HANDLE");
        }
        const RefletGBuffer gbuffer = adopted(given.gbuffer, "RefletFrameInfo.gbuffer");
        const Rectangle drawn = rectangleOf(*view, given);
        checkGBuffer(gbuffer, drawn);
        checkBoolean(given.clipYUp, "RefletFrameInfo.clipYUp");
        checkBoolean(given.clipDepthFromMinusOne, "RefletFrameInfo.clipDepthFromMinusOne");
        checkBoolean(given.backgroundIsEnvironment, "RefletFrameInfo.backgroundIsEnvironment");
        Frame frame = frameOf(*view, given, gbuffer, drawn);
        const ImportParams params = importParams(given, gbuffer, frame.context.view);
        view->commands = given.commandBuffer;
        view->hostImages.clear();
        view->recorder.begin(given.commandBuffer);
        startSize(*view, drawn.size);
        view->preExposure = frame.preExposure;
        try {
            waitForReaders(*view);
            HostImages host(*view);
            const HostSurfaces surfaces =
                hostSurfaces(gbuffer, [&](const RefletImage& image) { return host.add(image, drawn.size); });
            host.acquire();
            recordImport(*view, frame, surfaces, params);
        } catch (...) {
            view->recorder.drop();
            view->recorder.end();
            throw;
        }
        view->frame = frame;
        view->last.reset();
        note(*view, given, gbuffer);
    });
}

RefletResult refletEndFrame(RefletView view) {
    return onView(view, [&] {
        if (!view->frame) {
            failArgument("view: no frame has begun; call refletBeginFrame first");
        }
        checkNonePending(*view->frame);
        noteContradictions(*view);
        view->recorder.end();
        view->composedLast = static_cast<bool>(view->frame->composed);
        view->store->lastGeneration = view->recorder.generation();
        view->last = view->frame;
        view->frame.reset();
    });
}
