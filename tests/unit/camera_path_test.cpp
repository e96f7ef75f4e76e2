// Camera paths: keyframes, interpolation, loops, orbits, and errors in files.
#include "scene/camera_path.h"

#include "base/error.h"
#include "base/file.h"

#include <gtest/gtest.h>

namespace reflet::camera_path_test {
namespace {

class CameraPathTest : public testing::Test {
protected:
    ~CameraPathTest() override { std::filesystem::remove(file_); }

    [[nodiscard]] CameraPath load(const std::string& json) const {
        writeFileAtomically(file_, json);
        return loadCameraPath(file_, camera_);
    }
    /// Without the file's name.
    [[nodiscard]] std::string errorOf(const std::string& json) const {
        try {
            (void)load(json);
        } catch (const Error& error) {
            return std::string(error.what()).substr(file_.string().size());
        }
        return "none";
    }

    Camera camera_;

private:
    std::filesystem::path file_ =
        std::filesystem::path(testing::TempDir()) /
        (std::string(testing::UnitTest::GetInstance()->current_test_info()->name()) + ".json");
};

const std::string threeKeyframes = R"({"keyframes": [
    {"time": 0.1, "position": [0.3, 0.1, 5], "target": [0, 0, 0], "fov_y": 50},
    {"time": 0.7, "position": [1.7, 2.1, 5], "target": [0, 0.7, 0], "up": [0, 0, 1], "easing": "EASING"},
    {"time": 2.3, "position": [9.1, 2.1, 3], "target": [0.1, 0, 0.3]}]})";

std::string withEasing(const std::string& easing) {
    std::string text = threeKeyframes;
    return text.replace(text.find("EASING"), 6, easing);
}

TEST_F(CameraPathTest, GoesThroughEveryKeyframeExactlyWhateverTheEasing) {
    for (const std::string easing : {"linear", "smooth", "step", "ease-in", "ease-out"}) {
        const CameraPath path = load(withEasing(easing));
        EXPECT_EQ(path.at(0.1).position, vec3(0.3F, 0.1F, 5));
        EXPECT_FLOAT_EQ(path.at(0.1).fovY, glm::radians(50.0F));
        EXPECT_EQ(path.at(0.7).position, vec3(1.7F, 2.1F, 5)) << easing;
        EXPECT_EQ(path.at(0.7).target, vec3(0, 0.7F, 0)) << easing;
        EXPECT_EQ(path.at(0.7).up, vec3(0, 0, 1)) << easing;
        EXPECT_EQ(path.at(0.7).fovY, camera_.fovY) << "defaults to the view's";
        EXPECT_EQ(path.at(2.3).position, vec3(9.1F, 2.1F, 3)) << easing;
    }
}

TEST_F(CameraPathTest, StaysAtItsEndsBeforeAndAfter) {
    const CameraPath path = load(withEasing("linear"));
    EXPECT_EQ(path.at(0.0).position, path.at(0.1).position);
    EXPECT_EQ(path.at(100.0).position, path.at(2.3).position);
}

TEST_F(CameraPathTest, PassesKeyframesWithoutAJerkAndOvershootsNone) {
    const CameraPath path = load(withEasing("linear"));
    const double step = 1e-4;
    const vec3 before = (path.at(0.7).position - path.at(0.7 - step).position) / static_cast<float>(step);
    const vec3 after = (path.at(0.7 + step).position - path.at(0.7).position) / static_cast<float>(step);
    EXPECT_GT(glm::length(before), 1.0F);
    EXPECT_NEAR(glm::length(after - before), 0.0F, 0.05F);
    for (double time = 0.7; time < 2.3; time += 0.01) {
        EXPECT_EQ(path.at(time).position.y, 2.1F) << "two keyframes have the same height";
        EXPECT_LE(path.at(time).position.x, 9.1F);
    }
}

TEST_F(CameraPathTest, EvenKeyframesOnALineGiveEvenMotion) {
    const CameraPath path = load(R"({"keyframes": [{"time": 0, "position": [0, 0, 0], "target": [0, 0, -1]},
        {"time": 1, "position": [2, 0, 0], "target": [2, 0, -1]},
        {"time": 3, "position": [6, 0, 0], "target": [6, 0, -1]}]})");
    for (double time = 0.0; time <= 3.0; time += 0.125) {
        EXPECT_NEAR(path.at(time).position.x, 2.0 * time, 1e-6);
    }
}

TEST_F(CameraPathTest, EasingsRestWhereTheySay) {
    const auto xAt = [&](const std::string& easing, double time) {
        const std::string format = R"({"keyframes": [{"time": 0, "position": [0, 0, 0], "target": [0, 0, -1],
            "easing": ")" + easing +
                                   R"("}, {"time": 1, "position": [1, 0, 0], "target": [1, 0, -1]}]})";
        return load(format).at(time).position.x;
    };
    EXPECT_FLOAT_EQ(xAt("linear", 0.25), 0.25F);
    EXPECT_FLOAT_EQ(xAt("smooth", 0.25), 0.15625F);
    EXPECT_FLOAT_EQ(xAt("smooth", 0.75), 0.84375F);
    EXPECT_FLOAT_EQ(xAt("step", 0.999), 0.0F);
    EXPECT_FLOAT_EQ(xAt("ease-in", 0.25), 0.0625F);
    EXPECT_FLOAT_EQ(xAt("ease-out", 0.25), 0.4375F);
}

TEST_F(CameraPathTest, ALoopGoesRoundWithoutAJerk) {
    const CameraPath path = load(R"({"loop": true, "keyframes": [
        {"time": 1, "position": [0, 0, 5], "target": [0, 0, 0]},
        {"time": 2, "position": [5, 2, 0], "target": [0, 0, 0]},
        {"time": 3, "position": [0, 3, -5], "target": [0, 0, 0]},
        {"time": 4, "position": [-5, 1, 0], "target": [0, 0, 0]},
        {"time": 5, "position": [0, 0, 5], "target": [0, 0, 0]}]})");
    EXPECT_EQ(path.at(5.0).position, path.at(1.0).position);
    EXPECT_EQ(path.at(10.0).position, path.at(2.0).position);
    EXPECT_EQ(path.at(0.5).position, path.at(4.5).position);
    const float before = path.at(5.0).position.x - path.at(4.999).position.x;
    const float after = path.at(5.001).position.x - path.at(5.0).position.x;
    EXPECT_GT(after, 0.003F) << "five metres per second, across the loop's seam";
    EXPECT_NEAR(before, after, 1e-4F);
}

TEST_F(CameraPathTest, RefusesWhatItDoesNotUnderstand) {
    EXPECT_EQ(errorOf(R"({"keyframe": []})"), ": keyframe: unknown key; did you mean 'keyframes'?");
    EXPECT_EQ(errorOf("{}"), ": 'keyframes' is missing");
    EXPECT_EQ(errorOf(R"({"keyframes": []})"), ": keyframes: must be a list of keyframes, is []");
    const auto keyframe = [](const std::string& more) {
        return R"({"keyframes": [{"time": 0, "position": [0, 0, 1], "target": [0, 0, 0])" + more + "}]}";
    };
    EXPECT_EQ(errorOf(keyframe("")), "none");
    EXPECT_EQ(errorOf(keyframe(R"(, "fov": 60)")), ": keyframes[0].fov: unknown key; did you mean 'fov_y'?");
    EXPECT_EQ(errorOf(keyframe(R"(, "easing": "ease_in")")),
              ": keyframes[0].easing: must be one of linear, smooth, step, ease-in, ease-out; did you mean 'ease-in'?, "
              "is \"ease_in\"");
    EXPECT_EQ(errorOf(R"({"keyframes": [{"position": [0, 0, 1], "target": [0, 0, 0]}]})"),
              ": keyframes[0]: 'time' is missing");
    EXPECT_EQ(errorOf(R"({"keyframes": [{"time": 0, "position": [0, 0, 0], "target": [0, 0, 0]}]})"),
              ": keyframes[0]: position and target must not be the same point");
    EXPECT_EQ(errorOf(R"({"keyframes": [{"time": 2, "position": [0, 0, 1], "target": [0, 0, 0]},
                                        {"time": 2, "position": [0, 0, 2], "target": [0, 0, 0]}]})"),
              ": keyframes[1].time: must be more than the previous keyframe's (2), is 2");
    EXPECT_EQ(errorOf(R"({"loop": true, "keyframes": [{"time": 0, "position": [0, 0, 1], "target": [0, 0, 0]},
                                                      {"time": 2, "position": [0, 0, 2], "target": [0, 0, 0]}]})"),
              ": loop: the first and the last keyframe of a loop must have the same position and target");
}

TEST(Orbit, KeepsDistanceAndHeightAndComesBack) {
    Camera camera;
    camera.position = vec3(4, 2, 1);
    camera.target = vec3(1, 0.5F, 1);
    const Camera quarter = orbit(camera, camera.target, 0.25);
    EXPECT_NEAR(glm::length(quarter.position - vec3(1, 2, -2)), 0.0F, 1e-5F) << "counter-clockwise from above";
    EXPECT_EQ(quarter.target, camera.target);
    EXPECT_EQ(orbit(camera, camera.target, 0.0).position, camera.position);
    EXPECT_NEAR(glm::length(orbit(camera, camera.target, 1.0).position - camera.position), 0.0F, 1e-5F);
}

TEST(Orbit, CirclesTheVisibleSurfaceIfTheTargetIsOnlyADirection) {
    Scene scene;
    Mesh mesh;
    mesh.positions = {{-1, -1, 0}, {1, -1, 0}, {0, 1, 0}};
    mesh.indices = {0, 1, 2};
    for (const vec3& p : mesh.positions) {
        mesh.bounds.add(p);
    }
    scene.meshes.push_back(mesh);
    scene.instances.push_back({"far", 0, glm::translate(mat4(1.0F), vec3(0, 0, -7))});
    scene.instances.push_back({"near", 0, glm::translate(mat4(1.0F), vec3(0, 0, -3))});
    Camera camera;
    camera.position = vec3(0, 0, 5);
    camera.target = vec3(0, 0, 4);
    EXPECT_EQ(orbitPivot(camera, scene), camera.target);
    camera.aims = false;
    EXPECT_NEAR(glm::length(orbitPivot(camera, scene) - vec3(0, 0, -3)), 0.0F, 1e-5F);
    camera.position.y = 10.0F;
    camera.target.y = 10.0F;
    EXPECT_NEAR(glm::length(orbitPivot(camera, scene) - vec3(0, 10, -5)), 0.0F, 1e-5F)
        << "the point ahead nearest to the scene's centre";
}

}  // namespace
}  // namespace reflet::camera_path_test
