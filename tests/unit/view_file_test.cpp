// View files: their effects and their errors.
#include "scene/view_file.h"

#include "base/error.h"
#include "base/file.h"
#include "base/image_file.h"
#include "base/json_text.h"
#include "scene/builtin.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace reflet::view_file_test {
namespace {

/// Writes view files, applies them to a view, and returns error messages with the path shortened to "FILE".
class ViewFile : public ::testing::Test {
public:
    ViewFile(const ViewFile&) = delete;
    ViewFile& operator=(const ViewFile&) = delete;
    ViewFile(ViewFile&&) = delete;
    ViewFile& operator=(ViewFile&&) = delete;

protected:
    ViewFile()
        : path_(std::filesystem::path(::testing::TempDir()) /
                (std::string("reflet_") + ::testing::UnitTest::GetInstance()->current_test_info()->name() + ".json")) {}
    ~ViewFile() override {
        std::filesystem::remove(path_);
        std::filesystem::remove(sky_);
    }

    void apply(std::string_view json) {
        writeFileAtomically(path_, json);
        applyViewFile(path_, view_);
    }

    std::string errorOf(std::string_view json) {
        try {
            apply(json);
        } catch (const Error& error) {
            std::string message = error.what();
            const size_t name = message.find(path_.string());
            return name == std::string::npos ? message : message.replace(name, path_.string().size(), "FILE");
        }
        return "no error";
    }

    /// Writes an environment image of one texel next to the view file: reflet_view_file_sky.exr.
    void writeSky(const std::vector<float>& color) {
        sky_ = path_.parent_path() / "reflet_view_file_sky.exr";
        const ImageLayer layer{"", {1, 1, {"R", "G", "B"}, color}, PixelType::float32};
        writeExr(sky_, {&layer, 1});
    }

    View view_;

private:
    std::filesystem::path path_;
    std::filesystem::path sky_;
};

void expectNear(const vec3& a, const vec3& b) {
    EXPECT_LE(glm::length(a - b), 1e-6F) << a.x << ' ' << a.y << ' ' << a.z;
}

TEST_F(ViewFile, SetsEverythingItSpecifies) {
    apply(R"({ "camera": { "position": [6,1,0], "target": [0,0,0], "up": [0,2,0], "fov_y": 75, "near": 0.5 },
               "sun": { "direction": [0,-3,4], "irradiance": [3.14,0,1e3], "angular_diameter": 0.5 },
               "lamps": { "radius": 0.25 },
               "environment": { "radiance": [0.1,0.2,0.3] } })");
    EXPECT_EQ(view_.camera.position, vec3(6, 1, 0));
    EXPECT_EQ(view_.camera.target, vec3(0));
    EXPECT_EQ(view_.camera.up, vec3(0, 1, 0));
    EXPECT_FLOAT_EQ(view_.camera.fovY, glm::radians(75.0F));
    EXPECT_EQ(view_.camera.near, 0.5F);
    expectNear(view_.sun.direction, {0, -0.6F, 0.8F});
    EXPECT_EQ(view_.sun.irradiance, vec3(3.14F, 0, 1e3F));
    EXPECT_FLOAT_EQ(view_.sun.angularDiameter, glm::radians(0.5F));
    EXPECT_EQ(view_.lampRadius, 0.25F);
    EXPECT_EQ(view_.environment.radiance, vec3(0.1F, 0.2F, 0.3F));
}

TEST_F(ViewFile, NamesProbes) {
    EXPECT_FALSE(view_.probes);
    apply(R"({"probes": [{"position": [0,1,0], "box_min": [-1,0,-2], "box_max": [1,3,2]}]})");
    ASSERT_TRUE(view_.probes);
    ASSERT_EQ(view_.probes->size(), 1U);
    EXPECT_EQ(view_.probes->front().position, vec3(0, 1, 0));
    EXPECT_EQ(view_.probes->front().box.min, vec3(-1, 0, -2));
    EXPECT_EQ(view_.probes->front().box.max, vec3(1, 3, 2));
    apply("{}");
    EXPECT_EQ(view_.probes->size(), 1U) << "unspecified values stay";
    apply(R"({"probes": []})");
    EXPECT_TRUE(view_.probes->empty());
}

TEST_F(ViewFile, WithAnInvalidProbeIsAnError) {
    EXPECT_EQ(errorOf(R"({"probes": {}})"), "FILE: probes: must be an array of probes, is {}");
    EXPECT_EQ(errorOf(R"({"probes": [{"position": [0,1,0], "box_min": [-1,0,-2]}]})"),
              "FILE: probes[0]: 'box_max' is missing");
    EXPECT_EQ(errorOf(R"({"probes": [{"position": [0,1,0], "box_min": [-1,0,-2], "box_max": [1,0,2]}]})"),
              "FILE: probes[0].box_max: must be more than box_min on every axis, is [1,0,2]");
    EXPECT_EQ(errorOf(R"({"probes": [{"position": [0,3,0], "box_min": [-1,0,-2], "box_max": [1,3,2]}]})"),
              "FILE: probes[0].position: must be inside the box, is [0,3,0]");
    EXPECT_EQ(errorOf(R"({"probes": [{"position": [0,1], "box_min": [-1,0,-2], "box_max": [1,3,2]}]})"),
              "FILE: probes[0].position: must be 3 numbers, is [0,1]");
    EXPECT_EQ(errorOf(R"({"probes": [{"positoin": [0,1,0]}]})"),
              "FILE: probes[0].positoin: unknown key; did you mean 'position'?");
    std::string many = R"({"probes": [)";
    for (int i = 0; i < 17; ++i) {
        many += std::string(i > 0 ? "," : "") + R"({"position": [0,1,0], "box_min": [-1,0,-2], "box_max": [1,3,2]})";
    }
    EXPECT_EQ(errorOf(many + "]}"), "FILE: probes: must have at most 16 probes, has 17");
    EXPECT_FALSE(view_.probes);
}

TEST_F(ViewFile, NamesMirrors) {
    apply(R"({ "mirrors": ["looking glass", "pond"] })");
    EXPECT_EQ(view_.mirrors, (std::vector<std::string>{"looking glass", "pond"}));
    apply("{}");
    EXPECT_EQ(view_.mirrors.size(), 2U);
    EXPECT_EQ(errorOf(R"({ "mirrors": "pond" })"), "FILE: mirrors: must be a list of names, is \"pond\"");
    EXPECT_EQ(errorOf(R"({ "mirrors": [1] })"), "FILE: mirrors[0]: must be a name, is 1");
}

TEST_F(ViewFile, LeavesUnspecifiedValues) {
    view_.camera.position = {1, 2, 3};
    view_.sun.irradiance = vec3(7);
    view_.environment.radiance = vec3(8);
    apply("{}");
    apply(R"({"camera": {}, "sun": {}, "lamps": {}, "environment": {}})");
    EXPECT_EQ(view_.lampRadius, std::nullopt);
    apply(R"({"camera": {"target": [4,5,6]}, "sun": {"direction": [1,0,0]}})");
    EXPECT_EQ(view_.camera.position, vec3(1, 2, 3));
    EXPECT_EQ(view_.camera.target, vec3(4, 5, 6));
    EXPECT_EQ(view_.sun.irradiance, vec3(7));
    EXPECT_EQ(view_.sun.direction, vec3(1, 0, 0));
    EXPECT_EQ(view_.environment.radiance, vec3(8));
    apply(R"({"camera": {"position": [9,9,9]}})");
    EXPECT_EQ(view_.camera.target, vec3(4, 5, 6));
}

TEST_F(ViewFile, WithAnErrorChangesNothing) {
    EXPECT_NE(errorOf(R"({"camera": {"position": [9,9,9]}, "sun": {"direction": 1}})"), "no error");
    EXPECT_EQ(view_.camera.position, Camera{}.position);
}

TEST_F(ViewFile, ThatIsMissingIsAnError) {
    EXPECT_THROW(applyViewFile("no/such/view.json", view_), Error);
}

TEST_F(ViewFile, ThatIsMalformedIsAnErrorWithLineAndColumn) {
    EXPECT_EQ(errorOf("{\n  \"camera\": {\n    \"near\": 1,\n  }\n}"),
              "FILE:4:3: syntax error while parsing object key - unexpected '}'; expected string literal");
    EXPECT_TRUE(errorOf("").starts_with("FILE:1:1: ")) << errorOf("");
    EXPECT_TRUE(errorOf(R"({"camera": {"near": NaN}})").starts_with("FILE:1:21: "));
    EXPECT_TRUE(errorOf("{} {}").starts_with("FILE:1:4: "));
    EXPECT_EQ(errorOf("{\"camera\": {\"name\": \"1e999\",\n \"near\": 1e999}}"),
              "FILE:2:10: number overflow parsing '1e999'");
}

TEST_F(ViewFile, WithAKeyTwiceIsAnError) {
    EXPECT_EQ(errorOf(R"({"camera": {"near": 1, "near": 2}})"), "FILE: camera.near: duplicate key");
    EXPECT_EQ(errorOf(R"({"sun": {}, "sun": {}})"), "FILE: sun: duplicate key");
}

TEST_F(ViewFile, WithAnUnknownKeyIsAnErrorThatNamesTheNearest) {
    EXPECT_EQ(errorOf(R"({"camra": {}})"), "FILE: camra: unknown key; did you mean 'camera'?");
    EXPECT_EQ(errorOf(R"({"camera": {"fovY": 1}})"), "FILE: camera.fovY: unknown key; did you mean 'fov_y'?");
    EXPECT_EQ(errorOf(R"({"sun": {"size": 1}})"),
              "FILE: sun.size: unknown key; there are direction, irradiance, angular_diameter");
    EXPECT_EQ(errorOf(R"({"environment": {"colour": 1}})"),
              "FILE: environment.colour: unknown key; there are radiance, image, intensity, rotation");
}

TEST_F(ViewFile, WithSomethingElseWhereAnObjectBelongsIsAnError) {
    EXPECT_EQ(errorOf("[1]"), "FILE: must be an object, is [1]");
    EXPECT_EQ(errorOf(R"({"camera": null})"), "FILE: camera: must be an object, is null");
    EXPECT_EQ(errorOf(R"({"sun": "bright"})"), "FILE: sun: must be an object, is \"bright\"");
    EXPECT_EQ(errorOf(R"({"environment": 1})"), "FILE: environment: must be an object, is 1");
}

TEST_F(ViewFile, WithAValueOfTheWrongTypeOrLengthIsAnError) {
    EXPECT_EQ(errorOf(R"({"camera": {"fov_y": "wide"}})"), "FILE: camera.fov_y: must be a number, is \"wide\"");
    EXPECT_EQ(errorOf(R"({"camera": {"fov_y": true}})"), "FILE: camera.fov_y: must be a number, is true");
    EXPECT_EQ(errorOf(R"({"camera": {"position": [1,2]}})"), "FILE: camera.position: must be 3 numbers, is [1,2]");
    EXPECT_EQ(errorOf(R"({"camera": {"position": 1}})"), "FILE: camera.position: must be 3 numbers, is 1");
    EXPECT_EQ(errorOf(R"({"camera": {"target": {}}})"), "FILE: camera.target: must be 3 numbers, is {}");
    EXPECT_EQ(errorOf(R"({"sun": {"irradiance": [1,null,1]}})"),
              "FILE: sun.irradiance: must be 3 numbers, is [1,null,1]");
}

TEST_F(ViewFile, WithANumberOutOfRangeIsAnError) {
    EXPECT_EQ(errorOf(R"({"camera": {"fov_y": 200}})"),
              "FILE: camera.fov_y: must be between 1 and 179 degrees, is 200");
    EXPECT_EQ(errorOf(R"({"camera": {"near": 0}})"), "FILE: camera.near: must be between 1e-06 and 1000 metres, is 0");
    EXPECT_EQ(errorOf(R"({"camera": {"position": [0,1e300,0]}})"),
              "FILE: camera.position[1]: must be between -1e+12 and 1e+12 metres, is 1e+300");
    EXPECT_EQ(errorOf(R"({"sun": {"angular_diameter": 90.5}})"),
              "FILE: sun.angular_diameter: must be between 0 and 90 degrees, is 90.5");
    EXPECT_EQ(errorOf(R"({"sun": {"irradiance": [1,-1,1]}})"),
              "FILE: sun.irradiance[1]: must be between 0 and 1e+12, is -1");
    EXPECT_EQ(errorOf(R"({"lamps": {"radius": -0.1}})"),
              "FILE: lamps.radius: must be between 0 and 1000 metres, is -0.1");
    EXPECT_EQ(errorOf(R"({"environment": {"radiance": [0,0,-0.5]}})"),
              "FILE: environment.radiance[2]: must be between 0 and 1e+12, is -0.5");
}

TEST_F(ViewFile, WithADirectionOfZeroIsAnError) {
    EXPECT_EQ(errorOf(R"({"sun": {"direction": [0,0,0]}})"),
              "FILE: sun.direction: must be a direction of non-zero length, is [0,0,0]");
    EXPECT_EQ(errorOf(R"({"camera": {"up": [0,0,0]}})"),
              "FILE: camera.up: must be a direction of non-zero length, is [0,0,0]");
}

TEST_F(ViewFile, WithPositionAndTargetTheSameIsAnError) {
    const std::string expected = "FILE: camera: position and target must not be the same point";
    EXPECT_EQ(errorOf(R"({"camera": {"position": [1,2,3], "target": [1,2,3]}})"), expected);
    EXPECT_EQ(errorOf(R"({"camera": {"position": [0,0,0]}})"), expected);  // the view's current target
}

TEST_F(ViewFile, WithUpAlongTheViewIsAnError) {
    EXPECT_EQ(errorOf(R"({"camera": {"position": [0,5,0], "target": [0,0,0], "up": [0,1,0]}})"),
              "FILE: camera.up: must be a direction that is not parallel to the view, is [0,1,0]");
    EXPECT_EQ(errorOf(R"({"camera": {"position": [0,0,5], "target": [0,0,0], "up": [0,0,2]}})"),
              "FILE: camera.up: must be a direction that is not parallel to the view, is [0,0,2]");
}

TEST_F(ViewFile, CanLookStraightDownWithoutSayingWhereUpIs) {
    apply(R"({"camera": {"position": [0,5,0], "target": [0,0,0]}})");
    EXPECT_EQ(view_.camera.up, vec3(0, 0, -1));
}

TEST_F(ViewFile, ReadsAnEnvironmentImageFromItsOwnFolder) {
    view_.environment.radiance = vec3(8);
    writeSky({1.0F, 2.0F, 3.0F});
    apply(R"({"environment": {"image": "reflet_view_file_sky.exr", "intensity": 2.5, "rotation": 90}})");
    ASSERT_TRUE(view_.environment.image);
    EXPECT_EQ(view_.environment.image->data, (std::vector<float>{1, 2, 3}));
    EXPECT_EQ(view_.environment.intensity, 2.5F);
    EXPECT_FLOAT_EQ(view_.environment.rotation, glm::half_pi<float>());
    apply(R"({"environment": {"image": "reflet_view_file_sky.exr"}})");
    EXPECT_EQ(view_.environment.intensity, 1.0F);
    EXPECT_EQ(view_.environment.rotation, 0.0F);
    apply(R"({"environment": {"radiance": [1,1,1]}})");
    EXPECT_FALSE(view_.environment.image);
}

TEST_F(ViewFile, WithALightRemovesTheDefaultSun) {
    const View unlit = defaultView(Scene{});
    ASSERT_NE(unlit.sun.irradiance, vec3(0.0F));
    view_ = unlit;
    apply(R"({ "environment": { "radiance": [0, 0, 0] } })");
    EXPECT_EQ(view_.sun.irradiance, unlit.sun.irradiance) << "a black sky emits no light";
    apply(R"({ "environment": { "radiance": [0, 0, 1] } })");
    EXPECT_EQ(view_.sun.irradiance, vec3(0.0F));
    view_ = unlit;
    apply(R"({ "environment": { "radiance": [0, 0, 1] }, "sun": { "irradiance": [3, 2, 1] } })");
    EXPECT_EQ(view_.sun.irradiance, vec3(3, 2, 1));
    Scene sunny;
    sunny.sun = Sun{};
    sunny.sun->irradiance = {5, 5, 5};
    view_ = defaultView(sunny);
    apply(R"({ "environment": { "radiance": [0, 0, 1] } })");
    EXPECT_EQ(view_.sun.irradiance, vec3(5.0F)) << "the scene's own";
}

TEST_F(ViewFile, WithAnInvalidEnvironmentImageIsAnError) {
    EXPECT_EQ(errorOf(R"({"environment": {"image": 1}})"),
              "FILE: environment.image: must be 'sky', 'studio' or the name of an .hdr or .exr file, is 1");
    EXPECT_NE(errorOf(R"({"environment": {"image": "no/such/sky.hdr"}})").find("no/such/sky.hdr"), std::string::npos);
    EXPECT_NE(errorOf(R"({"environment": {"image": "sky.png"}})").find("must end in .hdr or .exr"), std::string::npos);
}

TEST_F(ViewFile, WithAnEnvironmentImageAndARadianceIsAnError) {
    EXPECT_EQ(
        errorOf(R"({"environment": {"image": "sky.hdr", "radiance": [1,1,1]}})"),
        "FILE: environment.radiance: cannot be given together with an image; to scale the image, use 'intensity'");
}

TEST_F(ViewFile, WithAPropertyOfAnEnvironmentImageThatIsNotGivenIsAnError) {
    const std::string expected = ": needs environment.image, which is not given";
    EXPECT_EQ(errorOf(R"({"environment": {"intensity": 2}})"), "FILE: environment.intensity" + expected);
    EXPECT_EQ(errorOf(R"({"environment": {"rotation": 0, "radiance": [0,0,0]}})"),
              "FILE: environment.rotation" + expected);
}

TEST_F(ViewFile, WithAnIntensityOrRotationOutOfRangeIsAnError) {
    writeSky({1e9F, 0.0F, 0.0F});
    EXPECT_EQ(errorOf(R"({"environment": {"image": "reflet_view_file_sky.exr", "intensity": -1}})"),
              "FILE: environment.intensity: must be between 0 and 1e+12, is -1");
    EXPECT_EQ(
        errorOf(R"({"environment": {"image": "reflet_view_file_sky.exr", "intensity": 1e4}})"),
        "FILE: environment.intensity: must be at most 1000, because the image has values up to 1e+09, is 10000.0");
    EXPECT_EQ(errorOf(R"({"environment": {"image": "reflet_view_file_sky.exr", "rotation": 361}})"),
              "FILE: environment.rotation: must be between -360 and 360 degrees, is 361");
}

TEST_F(ViewFile, MakesAnOrthographicCameraPerspectiveOnlyByAFieldOfView) {
    view_.camera.orthographicHeight = 10.0F;
    apply(R"({"camera": {"position": [0,1,9]}})");
    EXPECT_EQ(view_.camera.orthographicHeight, 10.0F);
    apply(R"({"camera": {"fov_y": 40}})");
    EXPECT_EQ(view_.camera.orthographicHeight, 0.0F);
}

TEST_F(ViewFile, CannotPutTheNearPlaneBehindTheFarPlaneOfAnOrthographicCamera) {
    view_.camera.orthographicHeight = 10.0F;
    view_.camera.far = 50.0F;
    EXPECT_EQ(errorOf(R"({"camera": {"near": 60}})"),
              "FILE: camera.near: must be less than 50 metres, the camera's far plane, is 60");
    apply(R"({"camera": {"near": 60, "fov_y": 40}})");
    EXPECT_EQ(view_.camera.near, 60.0F);
}

TEST_F(ViewFile, ShowsNoLongValueAndNoSecondLineInItsErrors) {
    const std::string message = errorOf(R"({"camera": {"fov_y": ")" + std::string(500, 'x') + "\"}}");
    EXPECT_EQ(message, "FILE: camera.fov_y: must be a number, is a long text");
    EXPECT_EQ(errorOf("{\"sun\": \"\xff\"}").find('\n'), std::string::npos);
}

TEST_F(ViewFile, SetsTheAnimationTime) {
    EXPECT_EQ(view_.time, 0.0);
    apply(R"({"time": 1.25})");
    EXPECT_EQ(view_.time, 1.25);
    apply(R"({"camera": {"fov_y": 40}})");
    EXPECT_EQ(view_.time, 1.25) << "unspecified values stay";
    EXPECT_EQ(errorOf(R"({"time": -1})"), "FILE: time: must be between 0 and 1e+06 seconds, is -1");
}

TEST_F(ViewFile, HasAnOrthographicHeightOrAFieldOfView) {
    apply(R"({"camera": {"orthographic_height": 4}})");
    EXPECT_EQ(view_.camera.orthographicHeight, 4.0F);
    EXPECT_EQ(errorOf(R"({"camera": {"orthographic_height": 4, "fov_y": 30}})"),
              "FILE: camera.orthographic_height: cannot be given together with fov_y: a camera is orthographic "
              "or perspective");
}

TEST_F(ViewFile, TurnsLampsOff) {
    apply(R"({"lamps": {"off": [3, 0]}})");
    EXPECT_EQ(view_.lampsOff, (std::vector<uint32_t>{0, 3}));
    apply(R"({"lamps": {"radius": 0.1}})");
    EXPECT_EQ(view_.lampsOff.size(), 2U) << "unspecified values stay";
    EXPECT_EQ(errorOf(R"({"lamps": {"off": [0.5]}})"), "FILE: lamps.off[0]: must be a whole number, is 0.5");
}

TEST_F(ViewFile, IsWrittenSoThatItReproducesTheView) {
    for (const BuiltinScene& builtin : builtinScenes()) {
        const std::optional<Scene> scene = makeBuiltinScene(builtin.name);
        ASSERT_TRUE(scene);
        View view = defaultView(*scene);
        view.camera.position += vec3(0.1F, 0.7F, -0.3F);
        view.camera.fovY = 1.2345F;
        view.sun.angularDiameter = 0.0123F;
        view.lampRadius = 0.3F;
        view.lampsOff = {1, 2};
        view.time = 1.0 / 3.0;
        view_ = defaultView(*scene);
        apply(jsonText(viewJson(view)));
        view.hasDefaultSun = false;  // the file names the sun
        EXPECT_EQ(view_.sun.direction, view.sun.direction) << builtin.name << ": to the last bit";
        EXPECT_EQ(view_.camera.up, view.camera.up) << builtin.name;
        if (view.camera.node < 0) {
            view_.camera.node = view.camera.node;
            view_.camera.aims = view.camera.aims;
            EXPECT_EQ(view_, view) << builtin.name;
        }
    }
}

}  // namespace
}  // namespace reflet::view_file_test
