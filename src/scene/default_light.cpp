// Chooses environments.
#include "scene/default_light.h"

#include "base/color.h"
#include "base/error.h"
#include "scene/environment.h"
#include "scene/sky.h"

#include <algorithm>
#include <cmath>
#include <memory>

namespace reflet {
namespace {

// Turns the image's centre toward a direction.
float rotationToward(const vec3& direction) {
    return std::hypot(direction.x, direction.z) > 1e-6F ? -std::atan2(direction.x, -direction.z) : 0.0F;
}

float elevationOf(const Sun& sun) {
    return std::asin(std::clamp(-glm::normalize(sun.direction).y, -1.0F, 1.0F));
}

// Keeps all values within the range of environments.
float usableIntensity(float wanted, const FloatImage& image) {
    const auto brightest = double(*std::ranges::max_element(image.data));
    const double most = largestRadiance / std::max(brightest, 1.0);
    return std::isfinite(wanted) ? static_cast<float>(std::clamp<double>(wanted, 0.0, most)) : static_cast<float>(most);
}

Environment made(const std::string& name, FloatImage image, float rotation) {
    Environment environment;
    environment.image = std::make_shared<FloatImage>(std::move(image));
    environment.imageFile = name;
    environment.rotation = rotation;
    return environment;
}

void addSky(View& view, bool keepsSun) {
    const bool dark = !(luminance(view.sun.irradiance) > 0.0F);
    const bool own = view.hasDefaultSun || (dark && !keepsSun);
    if (own && !view.hasDefaultSun) {  // a default sun stays where it is, whatever the camera is now
        view.sun = defaultSun(view.camera);
    }
    const float strength = own || dark ? Sky::sunLuminance : luminance(view.sun.irradiance);
    Sky sky = makeSky(elevationOf(view.sun));
    view.environment = made("sky", std::move(sky.image), rotationToward(-view.sun.direction));
    view.environment.intensity = usableIntensity(strength / Sky::sunLuminance, *view.environment.image);
    if (own) {
        view.sun.irradiance = sky.sunIrradiance;
        view.hasDefaultSun = true;
    }
}

// Irradiance that the lamps may give the scene: each at its distance from the scene's middle, but not nearer than half
// its radius.
float lampIrradiance(const Scene& scene) {
    const Aabb bounds = scene.bounds();
    const float radius = bounds.empty() ? 1.0F : std::max(0.5F * glm::length(bounds.size()), 1e-3F);
    const vec3 middle = bounds.empty() ? vec3(0.0F) : bounds.center();
    float sum = 0.0F;
    for (const Lamp& lamp : scene.lamps) {
        const float distance = std::max(glm::length(lamp.position - middle), 0.5F * radius);
        sum += luminance(lamp.intensity) / (lamp.type == Lamp::Type::directional ? 1.0F : distance * distance);
    }
    return sum;
}

}  // namespace

bool isMadeEnvironment(const std::string& name) {
    return name == "sky" || name == "studio";
}

void chooseEnvironment(View& view, const EnvironmentChoice& choice) {
    if (choice.name == "sky") {
        addSky(view, choice.keepsSun);
    } else if (choice.name == "studio") {
        view.environment = made("studio", makeStudio(), rotationToward(view.camera.target - view.camera.position));
    } else if (choice.name == "none") {
        view.environment = {};
    } else {
        const std::filesystem::path file = choice.base / choice.name;
        view.environment = {};
        view.environment.image = std::make_shared<FloatImage>(readEnvironmentImage(file));
        view.environment.imageFile = std::filesystem::absolute(file).lexically_normal().string();
    }
    if (view.hasDefaultSun && choice.name == "none") {
        view.sun.irradiance = defaultSun(view.camera).irradiance;
    } else if (view.hasDefaultSun && choice.name != "sky") {
        view.sun.irradiance = vec3(0.0F);
    }
    if (isMadeEnvironment(choice.name) && view.background.mode == Background::Mode::environment) {
        view.background.mode = Background::Mode::blur;
    }
}

std::optional<std::string> addDefaultLight(const Scene& scene, View& view) {
    if (scene.environment.image || scene.environment.radiance != vec3(0.0F)) {
        return std::nullopt;
    }
    if (isUnlit(scene)) {  // light changes nothing; the sky is only the background
        chooseEnvironment(view, {.name = "sky", .base = {}, .keepsSun = false});
        return std::nullopt;
    }
    const float ofSun = scene.sun ? luminance(scene.sun->irradiance) : 0.0F;
    const float ofLamps = lampIrradiance(scene);
    if (ofSun > 0.0F && elevationOf(view.sun) > 0.0F) {
        chooseEnvironment(view, {.name = "sky", .base = {}, .keepsSun = true});
        return "no environment: added a clear sky that fits its sun";
    }
    if (ofSun > 0.0F || ofLamps > 0.0F) {
        constexpr float share = 1.0F / 16.0F;  // 4 stops
        chooseEnvironment(view, {.name = "studio", .base = {}, .keepsSun = true});
        const FloatImage& image = *view.environment.image;
        view.environment.intensity =
            usableIntensity(share * (ofSun + ofLamps) / (pi * luminance(meanRadiance(image))), image);
        return fmt::format("lamps but no environment: added a dim studio (intensity {:.3g}), 4 stops below the lamps",
                           view.environment.intensity);
    }
    chooseEnvironment(view, {.name = "sky", .base = {}, .keepsSun = false});
    return "no light: added a clear sky with its sun";
}

}  // namespace reflet
