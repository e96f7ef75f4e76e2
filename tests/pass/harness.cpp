// Renders small scenes for tests.
#include "pass/harness.h"

#include "capture/show.h"
#include "support/device_fixture.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace reflet::test {

float Pictures::value(const std::string& show, unsigned x, unsigned y, unsigned channel) const {
    const FloatImage& image = images.at(show);
    return image.data.at((size_t(y) * image.width + x) * image.channels.size() + channel);
}

vec3 Pictures::color(const std::string& show, unsigned x, unsigned y) const {
    return {value(show, x, y, 0), value(show, x, y, 1), value(show, x, y, 2)};
}

vec3 Pictures::position(unsigned x, unsigned y) const {
    const float distance = value("depth", x, y);
    const vec2 ndc = 2.0F * (vec2(x, y) + 0.5F) / vec2(size) - 1.0F;
    // Any depth gives the direction; the length follows from the distance along the camera's axis.
    const vec4 p = view.clipToWorld * vec4(ndc, 0.5F, 1.0F);
    const vec3 ray = vec3(p) / p.w - vec3(view.eye);
    return vec3(view.eye) + ray * (distance / glm::dot(vec3(view.viewPlane), ray));
}

namespace {

// The process's device, outside of a fixture.
struct SharedDevice : DeviceTest {
    void TestBody() override {}
    using DeviceTest::device;
};

gpu::Device& testDevice() {
    return SharedDevice::device();
}

struct TestFrame {
    View view;
    uvec2 size;
};

Pictures renderNext(Renderer& renderer, const TestFrame& frame, const Settings& settings,
                    const std::vector<std::string>& shows) {
    const auto& [view, size] = frame;
    std::vector<ShowReadback> readbacks;
    renderer.render(view, size, 0, settings, [&](gpu::Frame& f, const FrameImages& images) {
        for (const std::string& show : shows) {
            readbacks.push_back(requestShow(f, images, findShow(show)));
        }
    });
    Pictures pictures{size, makeViewParams(view.camera, size, 0, 0), {}};
    for (const ShowReadback& readback : readbacks) {
        pictures.images[std::string(readback.show->name)] = fetchValues(renderer.frame(), readback, pictures.view);
    }
    return pictures;
}

Pictures renderFrames(const Scene& scene, const std::vector<TestFrame>& frames, const Settings& settings,
                      const std::vector<std::string>& shows) {
    Renderer renderer(testDevice(), scene, [](const std::string&) {});
    for (size_t i = 0; i + 1 < frames.size(); ++i) {
        renderNext(renderer, frames[i], settings, {});
    }
    return renderNext(renderer, frames.back(), settings, shows);
}

}  // namespace

Pictures render(const Scene& scene, const View& view, uvec2 size, const Settings& settings,
                const std::vector<std::string>& shows, uint32_t frames) {
    return renderFrames(scene, std::vector<TestFrame>(frames, {view, size}), settings, shows);
}

Pictures renderMean(const Scene& scene, const View& view, uvec2 size, const Settings& settings,
                    const std::vector<std::string>& shows, uint32_t frames, uint32_t seed) {
    Renderer renderer(testDevice(), scene, [](const std::string&) {});
    Pictures mean{size, makeViewParams(view.camera, size, 0, 0), {}};
    for (uint32_t i = 0; i < frames; ++i) {
        std::vector<ShowReadback> readbacks;
        renderer.render(view, size, seed, settings, [&](gpu::Frame& f, const FrameImages& images) {
            for (const std::string& show : shows) {
                readbacks.push_back(requestShow(f, images, findShow(show)));
            }
        });
        for (size_t k = 0; k < shows.size(); ++k) {
            const FloatImage frame = fetchValues(renderer.frame(), readbacks[k], mean.view);
            FloatImage& sum = mean.images[shows[k]];
            if (i == 0) {
                sum = {frame.width, frame.height, frame.channels, std::vector<float>(frame.data.size(), 0.0F)};
            }
            std::ranges::transform(sum.data, frame.data, sum.data.begin(),
                                   [&](float s, float v) { return s + v / static_cast<float>(frames); });
        }
    }
    return mean;
}

Pictures renderMoved(const Scene& scene, const View& before, const View& now, uvec2 size, const Settings& settings,
                     const std::vector<std::string>& shows, uint32_t framesBefore) {
    std::vector<TestFrame> frames(framesBefore, {before, size});
    frames.push_back({now, size});
    return renderFrames(scene, frames, settings, shows);
}

std::vector<Pictures> renderPath(const Scene& scene, const std::vector<View>& path, uvec2 size,
                                 const Settings& settings, const std::vector<std::string>& shows) {
    Renderer renderer(testDevice(), scene, [](const std::string&) {});
    std::vector<Pictures> pictures;
    pictures.reserve(path.size());
    for (const View& view : path) {
        pictures.push_back(renderNext(renderer, {view, size}, settings, shows));
    }
    return pictures;
}

Pictures renderResized(const Scene& scene, const View& view, uvec2 before, uvec2 now, const Settings& settings,
                       const std::vector<std::string>& shows) {
    return renderFrames(scene, {{view, before}, {view, now}}, settings, shows);
}

std::vector<std::string> passNames(const Scene& scene, const View& view, uvec2 size, const Settings& settings) {
    Renderer renderer(testDevice(), scene, [](const std::string&) {});
    renderer.render(view, size, 0, settings);
    expectSilentValidation("a frame of which only the passes are asked for");
    std::vector<std::string> names;
    std::ranges::transform(renderer.frame().passTimes(), std::back_inserter(names), &gpu::PassTime::name);
    return names;
}

View viewFrom(const vec3& position, const vec3& target) {
    View view;
    view.camera.position = position;
    view.camera.target = target;
    return view;
}

vec3 pixelDirection(const Camera& camera, uvec2 size, unsigned x, unsigned y) {
    const mat4 viewToWorld = glm::inverse(worldToView(camera));
    const float halfHeight = std::tan(0.5F * camera.fovY);
    const vec2 at = 2.0F * (vec2(x, y) + 0.5F) / vec2(size) - 1.0F;
    const float aspect = static_cast<float>(size.x) / static_cast<float>(size.y);
    return glm::normalize(mat3(viewToWorld) * vec3(at.x * halfHeight * aspect, -at.y * halfHeight, -1.0F));
}

Settings settingsOf(const std::vector<std::string>& assignments) {
    Settings settings;
    for (const std::string& assignment : assignments) {
        setSetting(settings, assignment);
    }
    return settings;
}

Range rangeOf(const FloatImage& image) {
    const auto [min, max] = std::ranges::minmax(image.data);
    const bool finite = std::ranges::all_of(image.data, [](float v) { return std::isfinite(v); });
    return {min, max, finite};
}

void expectSilentValidation(const std::string& during) {
    static size_t heard = 0;
    const auto& messages = testDevice().validationMessages();
    for (; heard < messages.size(); ++heard) {
        ADD_FAILURE() << "validation, " << during << ": " << messages[heard];
    }
}

Material lambertMaterial(const vec3& albedo) {
    Material material;
    material.baseColor = vec4(albedo, 1.0F);
    material.metallic = 0.0F;
    material.roughness = 1.0F;
    return material;
}

Scene sceneOf(const Material& material, Mesh mesh) {
    Scene scene;
    builtin::place(scene, "thing", builtin::addMaterial(scene, material), std::move(mesh));
    return scene;
}

}  // namespace reflet::test
