// Cameras and suns by angles, and the hints for options of other programs.
#include "job/camera_options.h"

#include "base/error.h"
#include "cli/option_hints.h"
#include "scene/builtin.h"
#include "scene/framing.h"
#include "scene/pose.h"

#include <gtest/gtest.h>

namespace reflet::camera_options_test {
namespace {

constexpr float aspect = 1.5F;

Scene cubes() {
    return makeBuiltinScene("cubes").value();
}

View viewOf(const Scene& scene) {
    View view;
    view.camera = framingCamera(scene, aspect);
    return view;
}

Camera placed(const CameraOptions& options, bool automatic = true) {
    const Scene scene = cubes();
    View view = viewOf(scene);
    placeCamera(options, scene, aspect, automatic, view);
    return view.camera;
}

std::string errorOf(const CameraOptions& options) {
    try {
        (void)placed(options);
        View view;
        placeSun(options, view);
    } catch (const UsageError& error) {
        return error.what();
    }
    return "";
}

void expectNear(const vec3& a, const vec3& b) {
    EXPECT_LT(glm::distance(a, b), 1e-4F * std::max(glm::length(b), 1.0F)) << b.x << " " << b.y << " " << b.z;
}

TEST(CameraOptions, AnOrbitLooksFromItsDirectionAndFramesTheScene) {
    const Camera camera = placed({.orbit = "90,30"});
    expectNear(glm::normalize(camera.position - camera.target), {std::sqrt(0.75F), 0.5F, 0.0F});
    const Scene scene = cubes();
    Camera framed = viewOf(scene).camera;
    framed.position = framed.target - camera.target + camera.position;
    frameScene(framed, scene, aspect);
    EXPECT_NEAR(glm::distance(camera.position, camera.target), glm::distance(framed.position, framed.target), 2.0F);
    const Camera twice = placed({.orbit = " 90, +30, 200%"});
    expectNear(twice.position - twice.target, 2.0F * (camera.position - camera.target));
    expectNear(twice.target, camera.target);
}

TEST(CameraOptions, ADistanceIsInMetresAndACameraWithATargetKeepsIt) {
    const Camera near = placed({.orbit = "-200,-45,7.5"});
    EXPECT_NEAR(glm::distance(near.position, near.target), 7.5F, 1e-3F);
    const Camera before = placed({});
    const Camera around = placed({.orbit = "10,20"}, false);
    expectNear(around.target, before.target);
    EXPECT_NEAR(glm::distance(around.position, around.target), glm::distance(before.position, before.target), 1e-3F);
}

TEST(CameraOptions, StraightDownHasTheFrontBelowInThePicture) {
    const Camera camera = placed({.orbit = "0,90,5"});
    expectNear(camera.position - camera.target, {0, 5, 0});
    EXPECT_GT(glm::dot(vec3(worldToView(camera) * vec4(0, 0, -1, 0)), vec3(0, 1, 0)), 0.99F);
}

TEST(CameraOptions, LookAtTakesPointsAndNamesOfNodes) {
    expectNear(placed({.lookAt = "1,-2,3e0"}).target, {1, -2, 3});
    const Scene scene = cubes();
    const std::string name = scene.instances.front().name;
    expectNear(placed({.lookAt = name}).target, instanceBounds(scene, scenePose(scene, 0.0), 0, {}).center());
    const Camera camera = placed({.orbit = "0,0,3", .lookAt = "1,2,3"});
    expectNear(camera.position, {1, 2, 6});
    try {
        (void)placed({.lookAt = name + "x"});
        FAIL();
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find("did you mean '" + name + "'"), std::string::npos) << error.what();
    }
}

TEST(CameraOptions, FovIsInDegreesAndZoomMagnifies) {
    EXPECT_NEAR(placed({.fov = 30.0}).fovY, glm::radians(30.0F), 1e-6F);
    EXPECT_NEAR(std::tan(0.5F * placed({.fov = 60.0, .zoom = 2.0}).fovY), 0.5F * std::tan(glm::radians(30.0F)), 1e-6F);
    EXPECT_NE(errorOf({.fov = 2.0, .zoom = 100.0}).find("it can be 1 to 179"), std::string::npos);
}

TEST(CameraOptions, ALensHasFocus) {
    const Camera lens = placed({.fov = 40.0, .fNumber = 2.0, .focus = "1,2,3"});
    EXPECT_NEAR(lens.apertureRadius, apertureOfFNumber(2.0F, glm::radians(40.0F), 24.0F), 1e-7F);
    expectNear(lens.focus.at(0).point, {1, 2, 3});
    EXPECT_EQ(placed({.fNumber = 2.0, .focus = "4.5"}).focusDistance, 4.5F);
    EXPECT_NE(errorOf({.focus = "4"}).find("--f-number"), std::string::npos);
}

TEST(CameraOptions, TheSunIsWhereItsAnglesSay) {
    View view;
    placeSun({.sun = "-90,45"}, view);
    expectNear(view.sun.direction, {std::sqrt(0.5F), -std::sqrt(0.5F), 0.0F});
    const Direction back = directionOf(-glm::dvec3(view.sun.direction));
    EXPECT_NEAR(back.azimuth, -90.0, 1e-4);
    EXPECT_NEAR(back.elevation, 45.0, 1e-4);
}

TEST(CameraOptions, ErrorsNameTheRanges) {
    for (const char* wrong : {"30", "a,b", "30,91", "400,0", "1,2,0", "1,2,-3", "1,2,x%", "1,2,3,4", "nan,0", ""}) {
        CameraOptions options{.orbit = std::string(wrong) + (*wrong == 0 ? "," : "")};
        EXPECT_NE(errorOf(options).find("-90 to 90"), std::string::npos) << wrong << ": " << errorOf(options);
    }
    EXPECT_NE(errorOf({.sun = "10,20,30"}).find("--sun must be AZIMUTH,ELEVATION: degrees"), std::string::npos);
    EXPECT_NE(errorOf({.lookAt = "1,2,x"}).find("-1e12 to 1e12"), std::string::npos);
}

TEST(OptionHints, NameOnlyOptionsThatTheCommandHas) {
    const auto hint = [](const std::string& typed, std::vector<std::string> has) {
        return optionHint(typed, [has](const std::string& name) { return std::ranges::count(has, name) > 0; });
    };
    EXPECT_EQ(hint("--camera-orbit", {"--orbit"}), "; use --orbit AZ,EL[,DISTANCE]");
    EXPECT_EQ(hint("--camera-orbit=1,2", {"--orbit"}), "; use --orbit AZ,EL[,DISTANCE]");
    EXPECT_EQ(hint("--camera-orbit", {"--aov"}), "");
    EXPECT_NE(hint("--spp", {"--effort", "--set"}).find("--effort high"), std::string::npos);
    EXPECT_EQ(hint("--samples", {"--spp", "--effort"}), "; use --spp N");
    EXPECT_NE(hint("--turntable", {}).find("reflet turntable"), std::string::npos);
    EXPECT_NE(endingHint(".gif").find(".webp"), std::string::npos);
    EXPECT_EQ(endingHint(".png"), "");
}

}  // namespace
}  // namespace reflet::camera_options_test
