// The tone map of the C API: checks, and what it hands out.
#include "api/calls.h"
#include "api/frame.h"
#include "gpu/listing.h"

#include <algorithm>
#include <cmath>

namespace reflet::api {

namespace {

constexpr float usualWhite = 203.0F;  // nits; ITU-R BT.2408
constexpr float usualPeak = 1000.0F;
constexpr float mostNits = 10000.0F;

bool isDisplayFormat(VkFormat format) {
    return isPlainDisplayFormat(format) || format == VK_FORMAT_B8G8R8A8_UNORM ||
           format == VK_FORMAT_A2R10G10B10_UNORM_PACK32;
}

VkFormat usualFormat(RefletTransfer transfer) {
    switch (transfer) {
        case REFLET_TRANSFER_SCRGB:
            return VK_FORMAT_R16G16B16A16_SFLOAT;
        case REFLET_TRANSFER_PQ:
            return VK_FORMAT_A2B10G10R10_UNORM_PACK32;
        default:
            return VK_FORMAT_R8G8B8A8_UNORM;
    }
}

void checkDisplayFormat(const RefletView_T& view, VkFormat format, const char* name) {
    const std::string given = gpu::formatName(format);
    if (!isDisplayFormat(format)) {
        const char* const cure =
            given.find("SRGB") != std::string::npos ? "; shaders cannot write it: give a view of the UNORM format" : "";
        failArgument(
            "{}: is {}{}; known are R8G8B8A8_UNORM, B8G8R8A8_UNORM, A2B10G10R10_UNORM_PACK32, "
            "A2R10G10B10_UNORM_PACK32, R16G16B16A16_SFLOAT",
            name, given, cure);
    }
    const gpu::Context& context = *view.owner.gpu;
    if (!isPlainDisplayFormat(format) && !context.writesWithoutFormat()) {
        failWith(REFLET_ERROR_MISSING_FEATURE,
                 "{}: is {}, which needs shaderStorageImageWriteWithoutFormat; enable it in vkCreateDevice, and say so "
                 "in RefletContextInfo.enabledFeatures",
                 name, given);
    }
    if (!context.storesImagesOf(format)) {
        failWith(REFLET_ERROR_MISSING_FEATURE, "{}: is {}, and the device has no storage images of it", name, given);
    }
}

void checkExposure(const RefletToneMapInfo& info) {
    if (info.exposure == nullptr) {
        return;
    }
    if (info.autoExposure != 0) {
        failArgument("RefletToneMapInfo.exposure: is given, and autoExposure is 1; choose one");
    }
    const RefletImage& given = *info.exposure;
    if (given.image == VK_NULL_HANDLE) {
        failArgument("RefletToneMapInfo.exposure.image: is VK_NULL_HANDLE; pass NULL for none");
    }
    if (given.width != 1 || given.height != 1) {
        failArgument("RefletToneMapInfo.exposure.width, height: are {}x{}; must be 1x1", given.width, given.height);
    }
    checkImage(given, "RefletToneMapInfo.exposure", {}, 1);
    if (gpu::formatName(given.format).find("SFLOAT") == std::string::npos) {
        failArgument("RefletToneMapInfo.exposure.format: is {}; must be a float format, such as R32_SFLOAT",
                     gpu::formatName(given.format));
    }
}

bool isSame(const RefletImage* a, const RefletImage& b) {
    return a != nullptr && a->image == b.image && a->baseLayer == b.baseLayer && a->baseLevel == b.baseLevel;
}

// The whole argument; the images of the host are added to `host`.
DisplayInputs displayInputs(const RefletView_T& view, const Frame& frame, const RefletToneMapInfo& info,
                            DisplayTarget& target, HostImages& host) {
    checkBoolean(info.autoExposure, "autoExposure");
    checkExposure(info);
    target = displayTarget(view, info);
    const uvec2 size = outputSizeOf(view);
    if (info.color != nullptr) {
        if (info.color->image == VK_NULL_HANDLE) {
            failArgument("color.image: is VK_NULL_HANDLE; pass NULL for the result of the effect before");
        }
        checkImage(*info.color, "color", {size, frame.inLarger}, 3);
    }
    // Without a picture of the output's size, the frame's own is shown.
    const bool upscaled = info.color != nullptr || frame.antialiased || frame.defocused || frame.blurred;
    if (info.output != nullptr) {
        checkOutput(*info.output, "RefletToneMapInfo.output", upscaled ? size : frame.size);
        if (isSame(info.color, *info.output) || isSame(info.exposure, *info.output)) {
            failArgument("RefletToneMapInfo.output: is the image of {}",
                         isSame(info.color, *info.output) ? "color" : "exposure");
        }
    }
    DisplayInputs in;
    in.automatic = info.autoExposure != 0;
    in.color = info.color != nullptr ? host.add(*info.color, size) : gpu::Image{};
    in.exposure = info.exposure != nullptr ? host.add(*info.exposure, uvec2(1)) : gpu::Image{};
    if (info.output != nullptr) {
        target.image = host.addOutput(*info.output, upscaled ? size : frame.size);
        target.offset = {info.output->offset[0], info.output->offset[1]};
    }
    host.acquire();
    return in;
}

}  // namespace

DisplayTarget displayTarget(const RefletView_T& view, const RefletToneMapInfo& info) {
    if (info.transfer != REFLET_TRANSFER_SRGB && info.transfer != REFLET_TRANSFER_SCRGB &&
        info.transfer != REFLET_TRANSFER_PQ) {
        failArgument("RefletToneMapInfo.transfer: is {}; known values are 0 to 2", static_cast<int>(info.transfer));
    }
    if (info.paperWhite != 0.0F && !(info.paperWhite >= 1.0F && info.paperWhite <= mostNits)) {
        failArgument("RefletToneMapInfo.paperWhite: is {}; must be 1 to {} nits, or 0", info.paperWhite, mostNits);
    }
    DisplayTarget target;
    target.transfer = static_cast<uint32_t>(info.transfer);
    target.paperWhite = info.paperWhite != 0.0F ? info.paperWhite : usualWhite;
    target.peakNits = info.peakLuminance != 0.0F ? info.peakLuminance : std::max(usualPeak, target.paperWhite);
    if (!(target.peakNits >= target.paperWhite && target.peakNits <= mostNits)) {
        failArgument("RefletToneMapInfo.peakLuminance: is {}; must be paperWhite, {}, to {} nits, or 0",
                     info.peakLuminance, target.paperWhite, mostNits);
    }
    const char* const name = info.output != nullptr ? "RefletToneMapInfo.output.format" : "RefletToneMapInfo.format";
    target.format = info.output != nullptr               ? info.output->format
                    : info.format != VK_FORMAT_UNDEFINED ? info.format
                                                         : usualFormat(info.transfer);
    checkDisplayFormat(view, target.format, name);
    if (info.transfer == REFLET_TRANSFER_SCRGB && target.format != VK_FORMAT_R16G16B16A16_SFLOAT) {
        failArgument("{}: is {}; scRGB has values above 1, and needs R16G16B16A16_SFLOAT", name,
                     gpu::formatName(target.format));
    }
    return target;
}

void recordToneMap(RefletView_T& view, Frame& frame, const Settings& settings, const DisplayInputs& in) {
    gpu::PassList& f = view.recorder;
    const lighting::Light light = pictureToMap(view, frame, settings, in.color);
    gpu::Image measured;
    if (in.automatic) {
        if (!lighting::canMeter(light, frame)) {
            failArgument(
                "autoExposure: needs a picture of the view's size; color is larger, and refletComposite has not run");
        }
        measured = lighting::exposure(f, view.store->exposure, settings, frame, light, frame.elapsed,
                                      std::log2(frame.preExposure));
    }
    Settings own = settings;
    own.tonemap.exposure -= std::log2(frame.preExposure);
    frame.exposure = {};
    frame.shownOn = in.target != nullptr ? *in.target : DisplayTarget{};
    if (in.target == nullptr) {
        frame.display = lighting::display(f, own, light.lit, measured);
    } else {
        frame.exposure = measured ? lighting::exposureFactor(f, measured) : gpu::Image{};
        const gpu::Image factor = measured ? frame.exposure : in.exposure;
        frame.display = lighting::displayFor(f, light.lit, own.tonemap, factor, *in.target);
    }
    finishCall(view, frame);
}

}  // namespace reflet::api

using namespace reflet;
using namespace reflet::api;

RefletResult refletToneMap(RefletView view, RefletSettings settings, const RefletImage* color, uint32_t autoExposure,
                           RefletImage* display) {
    return inFrame(view, settings, [&](Frame& frame, const Settings& values) {
        if (display == nullptr) {
            failArgument("display: is NULL");
        }
        RefletToneMapInfo info{};
        info.color = color;
        info.autoExposure = autoExposure;
        DisplayTarget target;
        HostImages host(*view);
        recordToneMap(*view, frame, values, displayInputs(*view, frame, info, target, host));
        *display = resultOf(frame.display);
    });
}

RefletResult refletToneMapTo(RefletView view, RefletSettings settings, const RefletToneMapInfo* info,
                             RefletDisplay* display) {
    return inFrame(view, settings, [&](Frame& frame, const Settings& values) {
        const RefletToneMapInfo given = adopted(info, "RefletToneMapInfo");
        const RefletDisplay asked = adopted<RefletDisplay>(display, "RefletDisplay");
        DisplayTarget target;
        HostImages host(*view);
        DisplayInputs in = displayInputs(*view, frame, given, target, host);
        in.target = &target;
        recordToneMap(*view, frame, values, in);
        RefletDisplay out{};
        out.structSize = asked.structSize;
        out.image = given.output != nullptr ? HostImages::left(*given.output) : resultOf(frame.display);
        out.exposure = resultOf(frame.exposure);
        std::memcpy(display, &out, out.structSize);
    });
}
