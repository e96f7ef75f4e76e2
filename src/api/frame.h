// Records a frame of a view, for the C API and refletPrepare. Arguments are already checked.
#pragma once

#include "api/handles.h"

#include <functional>

namespace reflet::api {

/// Runs the body of a function on a view: under the view's lock, with its memory account; reports failures.
RefletResult onView(RefletView view, const std::function<void()>& body);
/// The same between refletBeginFrame and refletEndFrame, and with settings.
RefletResult inFrame(RefletView view, RefletSettings settings,
                     const std::function<void(Frame&, const Settings&)>& body);

/// Queues contradictions in the current frame's inputs that were not reported before for the host's log.
void noteContradictions(RefletView_T& view);

/// Throws Failure once the device is known to be lost.
void checkDevice(const RefletContext_T& context);

/// Size of refletTemporal's output.
inline uvec2 outputSizeOf(const RefletView_T& view) {
    return view.outputSize.x > 0 ? view.outputSize : view.size;
}

/// The settings as the stages take them.
Settings settingsOfFrame(const RefletView_T& view, const Settings& settings, const lighting::Change& change);

/// Passed as the number of channels for depth images.
constexpr uint32_t depthChannel = 0;

/// The part of a host's image that is read: the rectangle of this size at RefletImage::offset.
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

/// Transitions the host's images for compute passes while it lives, and restores their layouts at the end.
class HostImages {
public:
    explicit HostImages(RefletView_T& view) : view_(view) {}
    ~HostImages();
    HostImages(const HostImages&) = delete;
    HostImages& operator=(const HostImages&) = delete;

    /// None for an absent image. size: of the part that is read; 0: all. layers, levels: those of its view.
    gpu::Image add(const RefletImage& image, uvec2 size, uint32_t layers = 1, uint32_t levels = 1);
    /// An image that passes write, in VK_IMAGE_LAYOUT_GENERAL. size: of the part that is written.
    gpu::Image addOutput(const RefletImage& image, uvec2 size);
    /// The output image with its layout, stages and access after this object has ended.
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
/// Throws Failure while rays wait for a host's answers: other lobes would change the light that these read, or miss
/// theirs.
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
/// Records the passes that a call has listed. Images that later calls or the host may read are kept until the frame
/// ends.
void finishCall(RefletView_T& view, const Frame& frame);

/// Frame sizes for the recorder. before: the size of the last frame.
gpu::FrameSizes sizesOf(const RefletView_T& view, uvec2 before);

/// Records all passes that a change of the frame size may need, without any work, so that their pipelines exist.
void recordRescaling(RefletView_T& view);
void recordImport(RefletView_T& view, Frame& frame, const HostSurfaces& host, const ImportParams& params);
gpu::Image recordSunShadow(RefletView_T& view, Frame& frame, const Settings& settings, const SunInputs& in);
/// light: see ContactParams.
gpu::Image recordContactShadows(RefletView_T& view, Frame& frame, const Settings& settings, const vec4& light);
/// lamps: missing members are filled in.
gpu::Image recordLampShadows(RefletView_T& view, Frame& frame, const Settings& settings,
                             std::vector<lighting::HostLamp>& lamps);
gpu::Image recordAmbientOcclusion(RefletView_T& view, Frame& frame, const Settings& settings);
/// The host's inputs for the rays of a lobe.
struct LobeInputsOfHost {
    gpu::Image light;
    const EnvironmentInputs& environment;
    const SourceInputs& sources;
};

LobeLight recordLobe(RefletView_T& view, Frame& frame, const Settings& settings, uint32_t lobe,
                     const LobeInputsOfHost& in);
/// The first half of recordLobe: ray generation and the screen-space march; the remaining rays are listed for the host,
/// in frame.pending.
MissedRays recordMissedRays(RefletView_T& view, Frame& frame, const Settings& settings, uint32_t lobe,
                            const LobeInputsOfHost& in);
/// The second half, once the host has answered them.
LobeLight recordAnswers(RefletView_T& view, Frame& frame, const Settings& settings);
LobeLight recordDenoise(RefletView_T& view, Frame& frame, const Settings& settings, uint32_t lobe, gpu::Image noisy);
/// light: none: the light that the lobes were given.
lighting::Light recordComposite(RefletView_T& view, Frame& frame, const Settings& settings, gpu::Image light);
/// color: none: the composite.
gpu::Image recordTemporal(RefletView_T& view, Frame& frame, const Settings& settings, gpu::Image color);
/// color: none: the antialiased picture, or the composite.
gpu::Image recordDepthOfField(RefletView_T& view, Frame& frame, const Settings& settings, const Lens& lens,
                              gpu::Image color);
/// color: none: the last picture of this frame.
gpu::Image recordMotionBlur(RefletView_T& view, Frame& frame, const Settings& settings, gpu::Image color);

/// Input of the tone map: a host's picture, or the frame's.
lighting::Light pictureToMap(RefletView_T& view, const Frame& frame, const Settings& settings, gpu::Image color);

struct DisplayInputs {
    gpu::Image color;                       ///< none: the frame's picture
    bool automatic = false;                 ///< exposure is measured
    gpu::Image exposure;                    ///< of the host, 1x1; none: that of the settings
    const DisplayTarget* target = nullptr;  ///< NULL: sRGB in an RGBA8 image of this frame
};

/// Target of a tone map, without the host's image: its encoding and the format of the image. Throws Failure.
DisplayTarget displayTarget(const RefletView_T& view, const RefletToneMapInfo& info);
void recordToneMap(RefletView_T& view, Frame& frame, const Settings& settings, const DisplayInputs& in);

}  // namespace reflet::api
