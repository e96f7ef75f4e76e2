// Light that files without enough of it get, environments by name, backgrounds by name.
#include "scene/default_light.h"

#include "base/color.h"
#include "scene/background.h"
#include "scene/builtin/assemble.h"
#include "scene/environment.h"
#include "scene/sky.h"
#include "scene/view_file.h"
#include "unit/message_of.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <limits>

namespace reflet::default_light_test {
namespace {

using test::messageOf;
using Mode = Background::Mode;

Scene boxScene() {
    Scene scene;
    scene.materials.emplace_back();
    builtin::place(scene, "box", 0, builtin::box(vec3(1.0F)), mat4(1.0F));
    return scene;
}

Lamp pointLamp(const vec3& position, float intensity) {
    Lamp lamp;
    lamp.position = position;
    lamp.intensity = vec3(intensity);
    return lamp;
}

TEST(DefaultLight, IsASkyWithItsSunForASceneWithoutLight) {
    const Scene scene = boxScene();
    View view = defaultView(scene);
    const vec3 direction = view.sun.direction;
    EXPECT_EQ(addDefaultLight(scene, view), "no light: added a clear sky with its sun");
    EXPECT_EQ(view.environment.imageFile, "sky");
    EXPECT_EQ(view.environment.intensity, 1.0F);
    EXPECT_EQ(view.sun.direction, direction) << "that of the default sun";
    EXPECT_NEAR(luminance(view.sun.irradiance), Sky::sunLuminance, 1e-3F);
    EXPECT_EQ(view.background.mode, Mode::blur);
    // The sky is brightest around the sun.
    const float toward = luminance(radianceFrom(view.environment, -direction));
    EXPECT_GT(toward, luminance(radianceFrom(view.environment, direction * vec3(1, -1, 1))));
    for (const float turn : {-0.5F, 0.5F}) {
        const vec3 aside = glm::angleAxis(turn, vec3(0, 1, 0)) * -direction;
        EXPECT_GT(toward, luminance(radianceFrom(view.environment, aside)));
    }
}

TEST(DefaultLight, KeepsTheSunOfASceneAndTurnsTheSkyToIt) {
    Scene scene = boxScene();
    scene.sun = Sun{.direction = glm::normalize(vec3(-1, -0.5F, 0)), .irradiance = vec3(60.0F)};
    View view = defaultView(scene);
    const auto added = addDefaultLight(scene, view);
    EXPECT_EQ(added, "no environment: added a clear sky that fits its sun");
    EXPECT_EQ(view.sun, *scene.sun);
    EXPECT_NEAR(view.environment.intensity, 20.0F, 1e-3F) << "as bright against the sun as the model's";
    EXPECT_GT(radianceFrom(view.environment, {1, 0.5F, 0}).g, 2.0F * radianceFrom(view.environment, {-1, 0.5F, 0}).g);
}

TEST(DefaultLight, IsADimStudioForLampsOnlyFourStopsBelowThem) {
    Scene scene = boxScene();
    scene.lamps = {pointLamp({0, 10, 0}, 400.0F)};
    View view = defaultView(scene);
    const auto added = addDefaultLight(scene, view);
    ASSERT_TRUE(added);
    EXPECT_NE(added->find("dim studio"), std::string::npos) << *added;
    EXPECT_EQ(view.environment.imageFile, "studio");
    EXPECT_EQ(view.sun.irradiance, vec3(0.0F));
    // The lamp's irradiance at the box is 400 / 10² = 4 W/m².
    const float mean = view.environment.intensity * luminance(meanRadiance(*view.environment.image));
    EXPECT_NEAR(glm::pi<float>() * mean, 4.0F / 16.0F, 1e-3F);
}

TEST(DefaultLight, IsADimStudioForASunFromBelow) {
    Scene scene = boxScene();
    scene.sun = Sun{.direction = {0, 1, 0}, .irradiance = vec3(4.0F)};
    View view = defaultView(scene);
    ASSERT_TRUE(addDefaultLight(scene, view));
    EXPECT_EQ(view.environment.imageFile, "studio");
    EXPECT_EQ(view.sun, *scene.sun);
}

TEST(DefaultLight, IsNotAddedToASceneWithAnEnvironment) {
    Scene scene = boxScene();
    scene.environment.radiance = vec3(0.1F);
    View view = defaultView(scene);
    const View before = view;
    EXPECT_EQ(addDefaultLight(scene, view), std::nullopt);
    EXPECT_EQ(view, before);
}

TEST(DefaultLight, ReplacesLightsThatAreOff) {
    Scene scene = boxScene();
    scene.sun = Sun{};
    scene.lamps = {pointLamp({0, 3, 0}, 0.0F)};
    View view = defaultView(scene);
    EXPECT_EQ(addDefaultLight(scene, view), "no light: added a clear sky with its sun");
    EXPECT_GT(luminance(view.sun.irradiance), 2.9F);
}

TEST(DefaultLight, StaysWithinRangeForLampsOfAnyIntensity) {
    for (const float intensity : {1e-30F, 1e30F, std::numeric_limits<float>::infinity()}) {
        Scene scene = boxScene();
        scene.lamps = {pointLamp({0, 3, 0}, intensity)};
        View view = defaultView(scene);
        (void)addDefaultLight(scene, view);
        EXPECT_TRUE(std::isfinite(view.environment.intensity)) << intensity;
        EXPECT_LE(view.environment.intensity, largestRadiance) << intensity;
    }
}

TEST(ChosenEnvironment, OfAnUnlitSceneChangesItsDefaultSun) {
    const View unlit = defaultView(boxScene());
    View view = unlit;
    chooseEnvironment(view, {.name = "studio"});
    EXPECT_EQ(view.sun.irradiance, vec3(0.0F));
    EXPECT_EQ(view.background.mode, Mode::blur);
    chooseEnvironment(view, {.name = "sky"});
    EXPECT_GT(luminance(view.sun.irradiance), 2.9F);
    view.background = {};
    chooseEnvironment(view, {.name = "none"});
    EXPECT_EQ(view, unlit) << "the default sun in the dark";
    EXPECT_NE(messageOf([&] { chooseEnvironment(view, {.name = "sun"}); }).find("sky, studio or none"),
              std::string::npos);
}

TEST(ChosenEnvironment, SkyLeavesASunThatWasStatedDark) {
    View view;
    chooseEnvironment(view, {.name = "sky", .base = {}, .keepsSun = true});
    EXPECT_EQ(view.sun, Sun{});
    chooseEnvironment(view, {.name = "sky", .base = {}, .keepsSun = false});
    EXPECT_GT(luminance(view.sun.irradiance), 2.9F);
}

TEST(ChosenEnvironment, InAViewFileIsByNameOrAnImageWithProperties) {
    const View unlit = defaultView(boxScene());
    const auto apply = [&](const char* text) {
        View view = unlit;
        applyViewJson(nlohmann::json::parse(text), "v.json", view);
        return view;
    };
    EXPECT_EQ(apply(R"({"environment": "studio"})").environment.imageFile, "studio");
    EXPECT_EQ(apply(R"({"environment": "none"})"), unlit);
    const View dim = apply(R"({"environment": {"image": "sky", "intensity": 0.5, "rotation": 90}})");
    EXPECT_EQ(dim.environment.intensity, 0.5F);
    EXPECT_NEAR(dim.environment.rotation, glm::half_pi<float>(), 1e-6F);
    const View low = apply(R"({"sun": {"direction": [0, -0.2, -1], "irradiance": [6, 6, 6]}, "environment": "sky"})");
    EXPECT_EQ(low.sun.irradiance, vec3(6.0F));
    EXPECT_NEAR(low.environment.intensity, 2.0F, 1e-3F);
    EXPECT_NEAR(std::abs(low.environment.rotation), glm::pi<float>(), 1e-5F);
    EXPECT_EQ(messageOf([&] { (void)apply(R"({"environment": {"image": "none"}})"); }),
              "v.json: environment.image: must be 'sky', 'studio' or the name of an .hdr or .exr file, is \"none\"");
    EXPECT_NE(messageOf([&] { (void)apply(R"({"environment": "skye"})"); }).find(".hdr or .exr"), std::string::npos);
}

TEST(ChosenEnvironment, IsTheSameAfterAViewFileWroteAndReadIt) {
    const Scene scene = boxScene();
    View view = defaultView(scene);
    (void)addDefaultLight(scene, view);
    for (const char* name : {"sky", "studio"}) {
        chooseEnvironment(view, {.name = name});
        view.environment.intensity = 0.37F;
        view.environment.rotation = 0.4F;
        for (const char* background : {"environment", "blur", "transparent", "0.25,0.5,1"}) {
            view.background = parseBackground(background);
            View read = defaultView(scene);
            applyViewJson(nlohmann::json(viewJson(view)), "v.json", read);
            const std::vector<float>& values = view.environment.image->data;
            ASSERT_EQ(read.environment.image->data.size(), values.size());
            for (size_t i = 0; i < values.size(); i += 997) {
                ASSERT_EQ(read.environment.image->data[i], values[i]) << name;
            }
            EXPECT_EQ(read.environment.intensity, view.environment.intensity);
            EXPECT_NEAR(read.environment.rotation, view.environment.rotation, 1e-6F);
            EXPECT_EQ(read.background, view.background) << background;
            EXPECT_EQ(read.sun.irradiance, view.sun.irradiance) << name;
        }
    }
}

TEST(BackgroundText, IsParsedAndNamesTheChoicesWhereItIsWrong) {
    EXPECT_EQ(parseBackground("environment"), Background{});
    EXPECT_EQ(parseBackground("blur").mode, Mode::blur);
    EXPECT_EQ(parseBackground("transparent").mode, Mode::transparent);
    EXPECT_EQ(parseBackground("white"), (Background{Mode::color, vec3(1.0F)}));
    EXPECT_EQ(parseBackground("0.25,0,1"), (Background{Mode::color, {0.25F, 0, 1}}));
    for (const char* wrong :
         {"", "0.5", "1,2,3", "0,0", "0,0,0,0", "0,0,0,", "a,b,c", "-0.1,0,0", "nan,0,0", "0, 0,0"}) {
        EXPECT_NE(messageOf([&] { (void)parseBackground(wrong); }).find("transparent"), std::string::npos) << wrong;
    }
    EXPECT_NE(messageOf([] { (void)parseBackground("bluer"); }).find("'blur'"), std::string::npos);
}

TEST(BackgroundText, InAViewFileIsANameOrThreeNumbers) {
    View view;
    applyViewJson(nlohmann::json::parse(R"({"background": [0.1, 0.2, 0.3]})"), "v.json", view);
    EXPECT_EQ(view.background, (Background{Mode::color, {0.1F, 0.2F, 0.3F}}));
    applyViewJson(nlohmann::json::parse(R"({"background": "blur"})"), "v.json", view);
    EXPECT_EQ(view.background.mode, Mode::blur);
    const auto complaint = [&](const char* text) {
        return messageOf([&] { applyViewJson(nlohmann::json::parse(text), "v.json", view); });
    };
    EXPECT_EQ(complaint(R"({"background": [0, 0, 2]})"), "v.json: background[2]: must be between 0 and 1, is 2");
    EXPECT_EQ(complaint(R"({"background": 1})"), "v.json: background: must be a name or three numbers of 0 to 1, is 1");
    EXPECT_NE(complaint(R"({"background": "pink"})").find("v.json: background: the background must be"),
              std::string::npos);
}

}  // namespace
}  // namespace reflet::default_light_test
