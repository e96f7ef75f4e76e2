// Frames of the target of the C API.
#include "api_machine.h"
#include "fuzz.h"

namespace reflet::fuzz {

std::unique_ptr<stub::HostFrame> ApiMachine::hostOf(const ViewSlot& slot) {
    const bool drawn = slot.drawn[0] > 0;
    auto host =
        std::make_unique<stub::HostFrame>(drawn ? slot.drawn[0] : slot.width, drawn ? slot.drawn[1] : slot.height);
    host->frame.renderSize[0] = slot.drawn[0];
    host->frame.renderSize[1] = slot.drawn[1];
    return host;
}

// Tells the driver that the device has executed all but the last ones.
void ApiMachine::finishFrames(ViewSlot& slot, size_t left) {
    while (slot.commands.size() > left) {
        for (VkCommandBuffer commands : slot.commands.front()) {
            stub::finishCommands(commands);
        }
        slot.commands.erase(slot.commands.begin());
    }
}

void ApiMachine::begin(ViewSlot& slot) {
    RefletView handle = viewOf(slot);
    const uint8_t kind = bytes_.byte();
    if (!slot.inFrame) {
        slot.drawn[0] = slot.drawn[1] = 0;
        if (kind % 8 >= 5) {  // dynamic resolution
            slot.drawn[0] = std::max(slot.width * (64 + kind / 4) / 127, 1U);
            slot.drawn[1] = std::max(slot.height * (64 + kind / 4) / 127, 1U);
        }
    }
    const auto host = hostOf(slot);
    host->look(slot.angle);
    if (bytes_.chance(128)) {
        host->look(slot.angle += 0.01F);
    }
    RefletFrameInfo& info = host->frame;
    info.frameIndex = slot.frames;
    refletJitter(slot.frames, info.jitter);
    if (kind >= 128) {
        info.restFrames = bytes_.byte();
        info.backgroundIsEnvironment = 1;
        info.preExposure = kind >= 192 ? 0.125F * float(1 + bytes_.byte()) : 0.0F;
    }
    if (bytes_.chance(64)) {  // a smaller G-buffer
        host->gbuffer.geometricNormal = host->gbuffer.f0 = host->gbuffer.motion = host->gbuffer.backDepth = {};
        host->gbuffer.excluded = host->gbuffer.unlit = host->gbuffer.reactive = {};
    }
    spoilSome(info);
    spoilSome(host->gbuffer);
    VkCommandBuffer commands = stub::beginCommands();
    if (info.commandBuffer == VK_NULL_HANDLE && !(wild_ && bytes_.chance(8))) {
        info.commandBuffer = commands;
    }
    if (!slot.inFrame && slot.alive) {
        finishFrames(slot, slot.framesInFlight - 1);
    }
    const RefletResult result = note(ApiCall::beginFrame, refletBeginFrame(handle, orNull(&info)));
    if (result == REFLET_ERROR_INVALID_ARGUMENT || result == REFLET_ERROR_INCOMPATIBLE_VERSION) {
        stub::finishCommands(commands);
        return;
    }
    slot.commands.push_back({commands});
    ++slot.frames;
    slot.inFrame = result == REFLET_SUCCESS;
    slot.pending = false;
}

void ApiMachine::end(ViewSlot& slot) {
    if (slot.pending && !bytes_.chance(20)) {
        effect(slot, static_cast<uint32_t>(ApiCall::answerRays));
    }
    RefletView handle = viewOf(slot);
    const RefletResult result = note(ApiCall::endFrame, refletEndFrame(handle));
    slot.inFrame = slot.inFrame && result != REFLET_SUCCESS;
}

void ApiMachine::wholeFrame(ViewSlot& slot) {
    if (!slot.alive) {
        createView(slot);
    }
    if (!slot.inFrame) {
        begin(slot);
    }
    // Of `order` below. Few at a time, mostly: that is what most mistakes take, and a sequence takes less time.
    constexpr std::array<uint32_t, 16> few{0x0201, 0x2280, 0x0008, 0x0240, 0x0030, 0x0002, 0x0004, 0x4300,
                                           0x0400, 0x2000, 0x4000, 0x1600, 0x0A40, 0x0000, 0x86C1, 0x00C8};
    const uint8_t kind = bytes_.byte();
    const uint32_t effects = kind < 160 ? few[kind % few.size()] : kind < 248 ? bytes_.bits() & bytes_.bits() : 0x7FFFU;
    constexpr std::array<ApiCall, 16> order{
        ApiCall::sunShadow,  ApiCall::lampShadows, ApiCall::contactShadows, ApiCall::ambientOcclusion,
        ApiCall::missedRays, ApiCall::answerRays,  ApiCall::diffuseGi,      ApiCall::reflections,
        ApiCall::denoise,    ApiCall::composite,   ApiCall::temporal,       ApiCall::depthOfField,
        ApiCall::motionBlur, ApiCall::toneMap,     ApiCall::toneMapTo,      ApiCall::useCommandBuffer};
    for (uint32_t i = 0; i < order.size(); ++i) {
        if ((effects >> i & 1U) != 0) {
            effect(slot, static_cast<uint32_t>(order.at(i)));
        }
    }
    if (!bytes_.chance(10)) {
        end(slot);
    }
}

void ApiMachine::effect(ViewSlot& slot, uint32_t which) {
    if (!slot.inFrame && !bytes_.chance(40)) {
        return;
    }
    constexpr auto first = static_cast<uint32_t>(ApiCall::sunShadow);
    constexpr auto last = static_cast<uint32_t>(ApiCall::answerRays);
    const auto call = which == static_cast<uint32_t>(ApiCall::useCommandBuffer)
                          ? ApiCall::useCommandBuffer
                          : static_cast<ApiCall>(first + (which - first) % (last - first + 1));
    const auto host = hostOf(slot);
    switch (call) {
        case ApiCall::useCommandBuffer: {
            RefletView handle = viewOf(slot);
            VkCommandBuffer commands = stub::beginCommands();
            if (note(call, refletUseCommandBuffer(handle, orNull(commands))) == REFLET_SUCCESS) {
                slot.commands.back().push_back(commands);
            } else {
                stub::finishCommands(commands);
            }
            break;
        }
        case ApiCall::sunShadow:
        case ApiCall::lampShadows:
        case ApiCall::contactShadows:
        case ApiCall::ambientOcclusion:
            return shadow(slot, call, *host);
        case ApiCall::diffuseGi:
        case ApiCall::reflections:
        case ApiCall::denoise:
        case ApiCall::missedRays:
        case ApiCall::answerRays:
            return lobe(slot, call, *host);
        case ApiCall::toneMap:
        case ApiCall::toneMapTo:
            return toneMap(slot, call, *host);
        default:
            return picture(slot, call, *host);
    }
}

void ApiMachine::shadow(ViewSlot& slot, ApiCall call, stub::HostFrame& host) {
    RefletView handle = viewOf(slot);
    RefletSettings settings = anySettings();
    RefletImage image{};
    RefletImage* const out = orNull(&image);
    RefletResult result = REFLET_SUCCESS;
    switch (call) {
        case ApiCall::sunShadow:
            host.sun.cascades = 1 + bytes_.below(2);
            spoilSome(host.sun);
            result = refletSunShadow(handle, settings, orNull(&host.sun), out);
            break;
        case ApiCall::lampShadows: {
            uint32_t count = 1 + bytes_.below(3);
            for (uint32_t i = 0; i < count; ++i) {
                spoilSome(host.lamps.at(i));
            }
            count = bytes_.chance(4) ? 17 * bytes_.below(2) : count;
            result = refletLampShadows(handle, settings, orNull(host.lamps.data()), count, out);
            break;
        }
        case ApiCall::contactShadows:
            host.contact.isPositional = bytes_.below(2);
            spoilSome(host.contact);
            result = refletContactShadows(handle, settings, orNull(&host.contact), out);
            break;
        default:
            result = refletAmbientOcclusion(handle, settings, out);
    }
    if (note(call, result) == REFLET_SUCCESS && (image.image == VK_NULL_HANDLE || image.width == 0)) {
        finding("success without an image");
    }
}

void ApiMachine::spoilLight(stub::HostFrame& host) {
    const uint8_t kind = bytes_.byte();
    host.light.environment = (kind & 3U) != 0 ? &host.environment : nullptr;
    host.environment.image = (kind & 4U) != 0 ? host.environment.image : RefletImage{};
    host.environment.revision = kind & 8U;
    host.environment.factor[0] = 1.0F;
    if ((kind & 16U) == 0) {
        host.light.specularFallback = host.light.irradiance = {};
    }
    host.light.probeCount = (kind & 32U) != 0 ? 2 : 0;
    host.light.planarViewCount = (kind & 64U) != 0 ? 1 : 0;
    host.light.planarViewsAfterScreen = kind >> 7U;
    if ((kind & 8U) != 0) {
        host.light.radianceCache = cacheOf(caches_[kind >> 7U]);
    }
    spoilSome(host.light);
    spoilSome(host.environment);
    if (host.light.probeCount == 2) {
        spoilSome(host.probes[0]);
        spoilSome(host.probes[1]);
    }
    if (host.light.planarViewCount == 1) {
        spoilSome(host.planarViews[0]);
    }
    if (wild_ && bytes_.chance(6)) {  // refused before anything is read
        host.light.probeCount = 17;
        host.light.planarViewCount = 5;
    }
}

void ApiMachine::lobe(ViewSlot& slot, ApiCall call, stub::HostFrame& host) {
    RefletView handle = viewOf(slot);
    RefletSettings settings = anySettings();
    RefletLobe lobe{};
    spoilOut(lobe);
    const auto kind = static_cast<RefletLobeKind>(bytes_.chance(6) ? bytes_.byte() : bytes_.below(2));
    if (call == ApiCall::denoise) {
        spoilSome(host.color);
        note(call, refletDenoise(handle, settings, kind, orNull(&host.color), orNull(&lobe)));
        return;
    }
    if (call == ApiCall::answerRays) {
        spoilSome(host.answers);
        const RefletLobeKind asked = slot.pending && !bytes_.chance(6) ? slot.pendingKind : kind;
        const bool made = note(call, refletAnswerRays(handle, settings, asked, orNull(&host.answers), orNull(&lobe))) ==
                          REFLET_SUCCESS;
        slot.pending = slot.pending && !made;
        return;
    }
    spoilLight(host);
    if (call == ApiCall::missedRays) {
        RefletMissedRays missed{};
        spoilOut(missed);
        const bool made = note(call, refletMissedRays(handle, settings, kind, orNull(&host.light), orNull(&missed))) ==
                          REFLET_SUCCESS;
        slot.pending = slot.pending || made;
        slot.pendingKind = made ? kind : slot.pendingKind;
        if (made && missed.capacity == 0) {
            finding("no room for rays");
        }
        return;
    }
    note(call, call == ApiCall::diffuseGi ? refletDiffuseGi(handle, settings, orNull(&host.light), orNull(&lobe))
                                          : refletReflections(handle, settings, orNull(&host.light), orNull(&lobe)));
}

void ApiMachine::picture(ViewSlot& slot, ApiCall call, stub::HostFrame& host) {
    RefletView handle = viewOf(slot);
    RefletSettings settings = anySettings();
    RefletImage image{};
    RefletImage* const out = orNull(&image);
    const bool given = bytes_.chance(80);
    if (call == ApiCall::depthOfField || call == ApiCall::motionBlur) {
        host.color.width = slot.outputWidth > 0 ? slot.outputWidth : slot.width;
        host.color.height = slot.outputWidth > 0 ? slot.outputHeight : slot.height;
    }
    spoilSome(host.color);
    const RefletImage* const color = given ? &host.color : nullptr;
    switch (call) {
        case ApiCall::composite: {
            RefletComposite sum{};
            spoilOut(sum);
            note(call, refletComposite(handle, settings, color, orNull(&sum)));
            return;
        }
        case ApiCall::temporal:
            note(call, refletTemporal(handle, settings, color, out));
            return;
        case ApiCall::depthOfField:
            spoilSome(host.lens);
            note(call, refletDepthOfField(handle, settings, orNull(&host.lens), color, out));
            return;
        default:
            note(call, refletMotionBlur(handle, settings, color, out));
    }
}

void ApiMachine::toneMap(ViewSlot& slot, ApiCall call, stub::HostFrame& host) {
    RefletView handle = viewOf(slot);
    RefletSettings settings = anySettings();
    const uint32_t width = slot.outputWidth > 0 ? slot.outputWidth : slot.width;
    const uint32_t height = slot.outputWidth > 0 ? slot.outputHeight : slot.height;
    for (RefletImage* image : {&host.color, &host.output}) {
        image->width = width;
        image->height = height;
    }
    const uint8_t kind = bytes_.byte();
    const bool given = (kind & 3U) == 0;
    spoilSome(host.color);
    if (call == ApiCall::toneMap) {
        RefletImage image{};
        const uint32_t automatic = bytes_.chance(6) ? bytes_.byte() : kind & 1U;
        note(call, refletToneMap(handle, settings, given ? &host.color : nullptr, automatic, orNull(&image)));
        return;
    }
    RefletToneMapInfo& info = host.toneMap;
    info.color = given ? &host.color : nullptr;
    info.autoExposure = kind >> 2U & 1U;
    info.exposure = info.autoExposure == 0 && (kind & 8U) != 0 ? &host.exposure : nullptr;
    info.output = (kind & 16U) != 0 ? &host.output : nullptr;
    info.transfer = static_cast<RefletTransfer>(kind >> 5U & 1U ? 2 * (kind >> 6U & 1U) : 0);
    if (info.transfer == REFLET_TRANSFER_PQ) {
        host.output.format = VK_FORMAT_A2B10G10R10_UNORM_PACK32;
    }
    spoilSome(info);
    spoilSome(host.exposure);
    spoilSome(host.output);
    RefletDisplay display{};
    spoilOut(display);
    note(call, refletToneMapTo(handle, settings, orNull(&info), orNull(&display)));
}

}  // namespace reflet::fuzz
