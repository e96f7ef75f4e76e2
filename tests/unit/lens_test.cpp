// The lens of a camera: its numbers, its keys in view files and camera paths, what it focuses on.
#include "base/error.h"
#include "base/file.h"
#include "base/json_text.h"
#include "scene/builtin/assemble.h"
#include "scene/camera_fields.h"
#include "scene/camera_json.h"
#include "scene/camera_path.h"
#include "scene/focus.h"
#include "scene/view_file.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <limits>

namespace reflet::lens_test {
namespace {

void apply(View& view, const std::string& camera) {
    applyViewJson(parseJson(R"({"camera": )" + camera + "}"), "FILE", view);
}

std::string errorOf(const std::string& camera) {
    View view;
    try {
        apply(view, camera);
    } catch (const Error& error) {
        return error.what();
    }
    return "no error";
}

View viewOf(const std::string& camera) {
    View view;
    apply(view, camera);
    return view;
}

// Two boxes; the one of that name moves along -z by a metre per second.
Scene movingScene() {
    Scene scene;
    const uint32_t paint = builtin::addMaterial(scene, builtin::plain("paint", {}));
    builtin::place(scene, "near box", paint, builtin::box(vec3(0.5F)));
    builtin::place(scene, "far box", paint, builtin::box(vec3(0.5F)), builtin::at({0, 0, -5}));
    scene.nodes.push_back({});
    scene.instances[0].node = 0;
    Channel channel;
    channel.target = Channel::Target::translation;
    channel.times = {0.0F, 4.0F};
    channel.values = {vec4(0.0F), vec4(0, 0, -4, 0)};
    scene.animations.push_back({"slide", {channel}});
    return scene;
}

float focusAt(View view, const Scene& scene, double time) {
    view.time = time;
    return posed(view, scene).camera.focusDistance;
}

TEST(CircleOfConfusion, FollowsTheThinLens) {
    Camera camera;
    camera.fovY = glm::radians(90.0F);
    camera.apertureRadius = 0.02F;
    camera.focusDistance = 4.0F;
    // At infinity: radius / focus times 500 pixels per unit of tangent.
    EXPECT_NEAR(circleOfConfusion(camera, std::numeric_limits<float>::infinity(), 1000.0F), 2.5F, 1e-5F);
    EXPECT_NEAR(circleOfConfusionScale(camera, 1000.0F), 2.5F, 1e-5F);
    EXPECT_EQ(circleOfConfusion(camera, 4.0F, 1000.0F), 0.0F);
    for (const float z : {0.5F, 2.0F, 3.0F, 10.0F, 1e6F}) {
        // A light at z on the axis is seen through the lens' edge at height h = r (z - f) / f where its ray meets z.
        const float expected = 0.02F * (z - 4.0F) / (z * 4.0F) * 500.0F;
        EXPECT_NEAR(circleOfConfusion(camera, z, 1000.0F), expected, 1e-4F * std::abs(expected)) << z;
    }
    EXPECT_LT(circleOfConfusion(camera, 1.0F, 1000.0F), 0.0F) << "negative before the plane of focus";
    camera.apertureRadius = 0.0F;
    camera.focusDistance = 0.0F;
    EXPECT_EQ(circleOfConfusion(camera, 1.0F, 1000.0F), 0.0F) << "a pinhole";
}

TEST(LensFile, ReadsTheLens) {
    const Camera camera =
        viewOf(R"({"aperture_radius": 0.02, "focus_distance": 3, "blades": 6, "blade_rotation": 10})").camera;
    EXPECT_EQ(camera.apertureRadius, 0.02F);
    EXPECT_EQ(camera.focusDistance, 3.0F);
    EXPECT_EQ(camera.blades, 6U);
    EXPECT_FLOAT_EQ(camera.bladeRotation, glm::radians(10.0F));
}

TEST(LensFile, TurnsAnFNumberIntoARadiusByTheSensor) {
    // 24 mm high, 2 atan(0.24) of view: a focal length of 50 mm; f/2: 25 mm wide.
    const double fovY = glm::degrees(2.0 * std::atan(0.24));
    EXPECT_NEAR(viewOf(fmt::format(R"({{"fov_y": {}, "f_number": 2}})", fovY)).camera.apertureRadius, 0.0125F, 1e-6F);
    EXPECT_NEAR(
        viewOf(fmt::format(R"({{"f_number": 2, "sensor_height": 12, "fov_y": {}}})", fovY)).camera.apertureRadius,
        0.00625F, 1e-6F);
}

TEST(LensFile, RefusesWhatContradictsItself) {
    EXPECT_EQ(errorOf(R"({"aperture_radius": 0.1, "f_number": 2})"),
              "FILE: camera.f_number: cannot be given together with aperture_radius: remove one of them");
    EXPECT_EQ(errorOf(R"({"focus": "box", "focus_distance": 2})"),
              "FILE: camera.focus: cannot be given together with focus_distance: remove one of them");
    EXPECT_EQ(errorOf(R"({"sensor_height": 24})"), "FILE: camera.sensor_height: needs f_number, which is not given");
    EXPECT_EQ(errorOf(R"({"orthographic_height": 2, "f_number": 2})"),
              "FILE: camera.f_number: needs a perspective camera: give aperture_radius in metres instead");
    EXPECT_EQ(errorOf(R"({"blades": 2})"), "FILE: camera.blades: must be 0 (round) or a whole number of 3 to 16, is 2");
    EXPECT_EQ(errorOf(R"({"blades": 5.5})"),
              "FILE: camera.blades: must be 0 (round) or a whole number of 3 to 16, is 5.5");
    EXPECT_EQ(errorOf(R"({"focus": 3})"), "FILE: camera.focus: must be the name of a node or a point [x, y, z], is 3");
    EXPECT_EQ(errorOf(R"({"aperture_radius": -1})"),
              "FILE: camera.aperture_radius: must be between 0 and 1000 metres, is -1");
}

TEST(LensFile, IsWrittenSoThatItReproducesTheLens) {
    for (const char* camera :
         {R"({"aperture_radius": 0.03, "focus_distance": 2.3, "blades": 7, "blade_rotation": -21.3})",
          R"({"f_number": 1.3, "focus": "near box"})", R"({"aperture_radius": 0.1, "focus": [0.1, 2, -3.7]})",
          R"({"aperture_radius": 0.1})", R"({"focus_distance": 5})"}) {
        const View view = viewOf(camera);
        View again = viewOf(R"({"aperture_radius": 9, "focus": "other", "blades": 3, "blade_rotation": 1})");
        applyViewJson(parseJson(jsonText(viewJson(view))), "FILE", again);
        again.camera.focusDistance = view.camera.focus.empty() ? again.camera.focusDistance : view.camera.focusDistance;
        again.hasDefaultSun = view.hasDefaultSun;
        EXPECT_EQ(again.camera, view.camera) << camera;
    }
}

TEST(Focus, FollowsANodeThatMovesAndACameraThatMoves) {
    const Scene scene = movingScene();
    View view = viewOf(R"({"position": [0,0,3], "target": [0,0,0], "aperture_radius": 0.1, "focus": "near box"})");
    EXPECT_FLOAT_EQ(focusAt(view, scene, 0.0), 3.0F);
    EXPECT_FLOAT_EQ(focusAt(view, scene, 1.0), 4.0F);
    const View once = posed(view, scene);
    EXPECT_FLOAT_EQ(focusAt(once, scene, 2.0), 5.0F) << "a view that was posed before";
    view.camera.position.z = 10.0F;
    EXPECT_FLOAT_EQ(focusAt(view, scene, 0.0), 10.0F);
    view.camera.position = {0, 4, 3};
    view.camera.target = {0, 4, 0};
    EXPECT_FLOAT_EQ(focusAt(view, scene, 0.0), 3.0F) << "the distance is along the view axis";
    view = viewOf(R"({"position": [0,0,3], "target": [0,0,0], "aperture_radius": 0.1, "focus": [5, 5, -4]})");
    EXPECT_FLOAT_EQ(focusAt(view, scene, 0.0), 7.0F);
    view.camera.focus[0].point.z = 50.0F;
    EXPECT_FLOAT_EQ(focusAt(view, scene, 0.0), view.camera.near) << "behind the camera";
}

TEST(Focus, IsTheTargetOrElseTheScenesCentreIfNothingIsSaid) {
    const Scene scene = movingScene();  // its centre is at z = -2.5
    View view = viewOf(R"({"position": [0,0,7], "target": [0,0,1], "aperture_radius": 0.1})");
    EXPECT_FLOAT_EQ(focusAt(view, scene, 0.0), 6.0F);
    View moved = posed(view, scene);
    moved.camera.position.z = 8.0F;
    EXPECT_FLOAT_EQ(focusAt(moved, scene, 0.0), 7.0F) << "it stays automatic";
    view.camera.aims = false;
    EXPECT_FLOAT_EQ(focusAt(view, scene, 0.0), 9.5F);
    view.camera.target = {0, 0, 9};
    EXPECT_FLOAT_EQ(focusAt(view, scene, 0.0), 2.0F) << "the centre is behind the camera";
    view.camera.apertureRadius = 0.0F;
    EXPECT_EQ(posed(view, scene).camera, view.camera) << "a pinhole needs none";
}

TEST(Focus, OfAnUnknownNodeSuggestsTheNearest) {
    const Scene scene = movingScene();
    const View view = viewOf(R"({"aperture_radius": 0.1, "focus": "nearbox"})");
    try {
        (void)posed(view, scene);
        FAIL();
    } catch (const Error& error) {
        EXPECT_STREQ(error.what(), "camera.focus: no node with a mesh is called 'nearbox'; did you mean 'near box'?");
    }
    EXPECT_THROW(checkFocus(view.camera, scene, "FILE: camera.focus"), Error);
}

CameraPath pathOf(const std::string& first, const std::string& second, const Camera& camera = {}) {
    const std::filesystem::path file = std::filesystem::path(testing::TempDir()) / "lens_path.json";
    writeFileAtomically(file, fmt::format(R"({{"keyframes": [
        {{"time": 0, "position": [0,0,3], "target": [0,0,0], {}}},
        {{"time": 2, "position": [0,0,3], "target": [0,0,0], {}}}]}})",
                                          first, second));
    CameraPath path = loadCameraPath(file, camera);
    std::filesystem::remove(file);
    return path;
}

TEST(FocusPull, MovesTheFocusBetweenDistancesAndBetweenThings) {
    const Scene scene = movingScene();
    View view;
    CameraPath path = pathOf(R"("aperture_radius": 0.1, "focus_distance": 2)",
                             R"("aperture_radius": 0.3, "focus_distance": 6, "blade_rotation": 40)");
    view.camera = path.at(1.0);
    EXPECT_FLOAT_EQ(view.camera.apertureRadius, 0.2F);
    EXPECT_FLOAT_EQ(view.camera.bladeRotation, glm::radians(20.0F));
    EXPECT_FLOAT_EQ(focusAt(view, scene, 0.0), 4.0F);

    path = pathOf(R"("f_number": 0.5, "focus": "near box")", R"("f_number": 0.5, "focus": [0, 0, -5])");
    for (const double time : {0.0, 0.5, 1.0, 2.0, 3.0}) {
        view.camera = path.at(time);
        const double share = std::min(time / 2.0, 1.0);
        // The box is at 3 m and moves away by 1 m/s; the point is at 8 m.
        EXPECT_NEAR(focusAt(view, scene, time), (1.0 - share) * (3.0 + time) + share * 8.0, 1e-4) << time;
    }
}

TEST(FocusPull, KeepsTheViewsOwnLensWhereKeyframesSayNothing) {
    const Scene scene = movingScene();
    Camera camera = viewOf(R"({"aperture_radius": 0.1, "focus": "near box", "blades": 5})").camera;
    View view;
    view.camera = pathOf(R"("fov_y": 40)", R"("fov_y": 50)", camera).at(1.0);
    EXPECT_EQ(view.camera.blades, 5U);
    EXPECT_EQ(view.camera.focus, camera.focus);
    EXPECT_FLOAT_EQ(focusAt(view, scene, 1.0), 4.0F);
    EXPECT_THROW(pathOf(R"("focus": "near box")", R"("focus": "neer box")").checkFocus(scene, "FILE"), Error);
}

// Every row of the table reaches the record and the view file.
TEST(CameraFields, AllCountInRecordsPathsAndViewFiles) {
    Camera camera;
    camera.apertureRadius = 0.1F;
    for (const CameraField& field : cameraFields()) {
        Camera base = camera;
        base.orthographicHeight = field.part == CameraField::Part::orthographic ? 3.0F : 0.0F;
        Camera other = base;
        std::visit([&](const auto member) { other.*member += 1; }, field.member);
        EXPECT_NE(cameraRecord(other), cameraRecord(base)) << field.key;
        EXPECT_EQ(cameraJson(other) != cameraJson(base), field.inFiles) << field.key;
        EXPECT_EQ(followedValues(other) != followedValues(base), field.followed) << field.key;
        EXPECT_EQ(withFollowedValues(base, followedValues(other)) == other, field.followed) << field.key;
    }
}

TEST(CameraFields, OfALensDoNotChangeTheRecordOfAPinhole) {
    Camera other;
    other.blades = 5;
    other.focusDistance = 3.0F;
    EXPECT_EQ(cameraRecord(other), cameraRecord(Camera{}));
}

}  // namespace
}  // namespace reflet::lens_test
