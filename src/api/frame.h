// A frame of a view, as the C API and refletPrepare record it, on values that are checked already.
#pragma once

#include "api/handles.h"

#include <functional>

namespace reflet::api {

/// Runs the body of a function on a view: under its context's lock, with its memory account, telling failures.
RefletResult onView(RefletView view, const std::function<void()>& body);
/// The same between refletBeginFrame and refletEndFrame, and with settings.
RefletResult inFrame(RefletView view, RefletSettings settings,
                     const std::function<void(Frame&, const Settings&)>& body);

/// Leaves what contradicts itself in the current frame, and was not told before, to the host's log.
void noteContradictions(RefletView_T& view);

/// Throws Failure once the device is known to be lost.
void checkDevice(const RefletContext_T& context);

/// The size of refletTemporal's pictures.
inline uvec2 outputSizeOf(const RefletView_T& view) {
    return view.outputSize.x > 0 ? view.outputSize : view.size;
}

/// The settings as the stages take them.
Settings settingsOfFrame(const RefletView_T& view, const Settings& settings, const lighting::Change& change);

/// In place of a number of channels: depth.
constexpr uint32_t depthChannel = 0;

/// What is read of an image of the host: the rectangle of this size at RefletImage::offset.
struct Rectangle {
    uvec2 size{0};          ///< 0: all of the image, which has no offset
    bool inLarger = false;  ///< the image may be larger
};

/// Throws Failure if an image cannot be sampled, has another size or lacks channels. name: of the field.
void checkImage(const RefletImage& image, const char* name, const Rectangle& read, uint32_t channels);
/// The same for one that is written.
void checkOutput(const RefletImage& image, const char* name, uvec2 size);

/// Whether it has a depth aspect.
bool isDepthFormat(VkFormat format);

/// Makes the host's images readable by compute passes while it lives, and leaves them as they were.
class HostImages {
public:
    explicit HostImages(RefletView_T& view) : view_(view) {}
    ~HostImages();
    HostImages(const HostImages&) = delete;
    HostImages& operator=(const HostImages&) = delete;

    /// None for an absent one. size: of what is read of it; 0: all. layers, levels: that its view has.
    gpu::Image add(const RefletImage& image, uvec2 size, uint32_t layers = 1, uint32_t levels = 1);
    /// One that passes write, in VK_IMAGE_LAYOUT_GENERAL. size: of what is written of it.
    gpu::Image addOutput(const RefletImage& image, uvec2 size);
    /// As the host finds it once this has ended.
    [[nodiscard]] static RefletImage left(const RefletImage& output);
    /// Records the barriers of all images added so far.
    void acquire();

private:
    struct Given {
        RefletImage image;
        uint32_t layers;
        uint32_t levels;
        bool written = false;
    };

    gpu::Image adopt(const RefletImage& image, uvec2 size, VkImageLayout layout);

    RefletView_T& view_;
    std::vector<Given> images_;
    std::vector<VkImageMemoryBarrier2> back_;  ///< made by acquire(): the destructor must not allocate
};

const char* lobeName(uint32_t lobe);
/// Throws Failure while rays wait for a host's answers: other lobes would change what these read, or miss their light.
void checkNonePending(const Frame& frame);

/// A result for the host.
RefletImage resultOf(const gpu::Image& image);

struct SunInputs {
    gpu::Image map;
    bool reversed = true;
    SunShadowParams sun{};
    vec3 toSun{0.0F};
    float slope = 0.0F;  ///< of lighting::sunSlope
    bool contact = false;
};

struct SourceInputs;

struct EnvironmentInputs {
    gpu::Image image;
    VkImageView from = VK_NULL_HANDLE;
    uint64_t revision = 0;
    EnvironmentParams params{};
};

/// The frame's context with the tables that stages read, which are made for the first of them.
const lighting::ViewContext& contextOf(RefletView_T& view, Frame& frame);
/// Records what a call has listed. What later calls and the host may read stays for the rest of the frame.
void finishCall(RefletView_T& view, const Frame& frame);

/// For the recorder. before: the size of the last frame.
gpu::FrameSizes sizesOf(const RefletView_T& view, uvec2 before);

/// All passes that a change of the frames' size may need, with nothing to do.
void recordRescaling(RefletView_T& view);
void recordImport(RefletView_T& view, Frame& frame, const HostSurfaces& host, const ImportParams& params);
gpu::Image recordSunShadow(RefletView_T& view, Frame& frame, const Settings& settings, const SunInputs& in);
/// light: see ContactParams.
gpu::Image recordContactShadows(RefletView_T& view, Frame& frame, const Settings& settings, const vec4& light);
/// lamps: are completed.
gpu::Image recordLampShadows(RefletView_T& view, Frame& frame, const Settings& settings,
                             std::vector<lighting::HostLamp>& lamps);
gpu::Image recordAmbientOcclusion(RefletView_T& view, Frame& frame, const Settings& settings);
/// What rays of a lobe find, as the host gives it.
struct LobeInputsOfHost {
    gpu::Image light;
    const EnvironmentInputs& environment;
    const SourceInputs& sources;
};

LobeLight recordLobe(RefletView_T& view, Frame& frame, const Settings& settings, uint32_t lobe,
                     const LobeInputsOfHost& in);
/// The first half of recordLobe: rays, the screen, and what is left for the host, in frame.pending.
MissedRays recordMissedRays(RefletView_T& view, Frame& frame, const Settings& settings, uint32_t lobe,
                            const LobeInputsOfHost& in);
/// The second half, once the host has answered them.
LobeLight recordAnswers(RefletView_T& view, Frame& frame, const Settings& settings);
LobeLight recordDenoise(RefletView_T& view, Frame& frame, const Settings& settings, uint32_t lobe, gpu::Image noisy);
/// light: none: what the lobes were given.
lighting::Light recordComposite(RefletView_T& view, Frame& frame, const Settings& settings, gpu::Image light);
/// color: none: what was composited.
gpu::Image recordTemporal(RefletView_T& view, Frame& frame, const Settings& settings, gpu::Image color);
/// color: none: what was antialiased, or composited.
gpu::Image recordDepthOfField(RefletView_T& view, Frame& frame, const Settings& settings, const Lens& lens,
                              gpu::Image color);
/// color: none: the last picture of this frame.
gpu::Image recordMotionBlur(RefletView_T& view, Frame& frame, const Settings& settings, gpu::Image color);

/// What the tone map is given: a host's picture, or the frame's.
lighting::Light pictureToMap(RefletView_T& view, const Frame& frame, const Settings& settings, gpu::Image color);

struct DisplayInputs {
    gpu::Image color;                       ///< none: the frame's picture
    bool automatic = false;                 ///< exposure is measured
    gpu::Image exposure;                    ///< of the host, 1x1; none: that of the settings
    const DisplayTarget* target = nullptr;  ///< NULL: sRGB in an RGBA8 image of this frame
};

/// Where a tone map goes, without the image of the host. Throws Failure. The image it makes or takes is of its format.
DisplayTarget displayTarget(const RefletView_T& view, const RefletToneMapInfo& info);
void recordToneMap(RefletView_T& view, Frame& frame, const Settings& settings, const DisplayInputs& in);

}  // namespace reflet::api
