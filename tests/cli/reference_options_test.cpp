// Effects of the options of `reflet reference`, of its scene and of its view file.
#include "base/json_text.h"
#include "cli/reference_program.h"

#include <nlohmann/json.hpp>

#include <algorithm>

namespace reflet::reference_options_test {
namespace {

const std::string tiltedCube = "builtin:tilted-cube";  // stands before a background

class ReferenceOptions : public Reference {
protected:
    [[nodiscard]] double relativeMse(const std::string& a, const std::string& b) const {
        const Outcome done = run({"compare", a, b, "--json"});
        EXPECT_TRUE(quietSuccess(done));
        return parseJson(done.out)["relative_mse"].get<double>();
    }
};

/// Number of values that are neither 0 nor 1.
ptrdiff_t between(const FloatImage& image) {
    return std::ranges::count_if(image.data, [](float v) { return v > 0.0F && v < 1.0F; });
}

TEST_F(ReferenceOptions, WithoutBouncesThereIsNoIndirectLight) {
    Images none = traced(cubes, {"--spp", "2", "--bounces", "0"});
    EXPECT_EQ(largest(none["indirect_diffuse"]), 0.0F);
    EXPECT_EQ(largest(none["indirect_specular"]), 0.0F);
    EXPECT_EQ(none[""].data, none["direct"].data);
}

TEST_F(ReferenceOptions, EachBounceBringsMoreLight) {
    const Arguments common{"--spp", "8", "--bounces"};
    float before = 0.0F;
    for (const char* bounces : {"0", "1", "2", "4"}) {
        Arguments all = common;
        all.emplace_back(bounces);
        const float light = mean(traced("builtin:cornell", all)[""]);
        EXPECT_GT(light, before) << bounces << " bounces";
        before = light;
    }
    EXPECT_GE(mean(traced("builtin:cornell", {"--spp", "8"})[""]), before);  // with no limit
}

TEST_F(ReferenceOptions, AClampBoundsTheIndirectLightOfSamples) {
    const Images free = traced("builtin:cornell", {"--spp", "4"});
    const Images bound = traced("builtin:cornell", {"--spp", "4", "--clamp", "0.05"});
    EXPECT_EQ(bound.at("direct").data, free.at("direct").data);
    EXPECT_GT(*std::ranges::max_element(free.at("indirect_diffuse").data), 0.1F);
    const FloatImage& diffuse = bound.at("indirect_diffuse");
    for (size_t i = 0; i < diffuse.data.size(); i += 3) {
        const float* c = &diffuse.data[i];
        EXPECT_LE(0.2126F * c[0] + 0.7152F * c[1] + 0.0722F * c[2], 0.0501F);
    }
}

TEST_F(ReferenceOptions, APinholeIgnoresTheLensAndAnUnknownFocusIsRefused) {
    const auto picture = [&](const Arguments& more) { return traced(cubes, more).at("").data; };
    const std::vector<float> sharp = picture({"--spp", "1"});
    write("lens.json", R"({"camera": {"f_number": 0.1, "focus_distance": 2, "blades": 5}})");
    EXPECT_NE(picture({"--spp", "1", "--view-file", "lens.json"}), sharp);
    EXPECT_EQ(picture({"--spp", "1", "--view-file", "lens.json", "--pinhole"}), sharp);
    write("lost.json", R"({"camera": {"f_number": 2, "focus": "bocks"}})");
    EXPECT_TRUE(refused(run({"reference", cubes, "--view-file", "lost.json", "-o", "a.exr"}), 1,
                        {"lost.json: camera.focus: no node with a mesh is called 'bocks'"}));
}

TEST_F(ReferenceOptions, WhatTheCameraSeesNeverBringsMoreLightThanEverything) {
    Images all = traced(cubes, {"--spp", "8"});
    Images visible = traced(cubes, {"--spp", "8", "--visible-only"});
    for (const char* layer : {"", "direct", "indirect_diffuse", "indirect_specular"}) {
        EXPECT_LE(mean(visible[layer]), mean(all[layer])) << layer;
    }
    EXPECT_LT(mean(visible["indirect_diffuse"]), mean(all["indirect_diffuse"]));
    EXPECT_LT(mean(visible["indirect_specular"]), mean(all["indirect_specular"]));
    for (const char* layer : {"direct", "albedo", "normal", "depth", "sun_visibility"}) {
        EXPECT_EQ(visible[layer].data, all[layer].data) << layer;  // of the same paths
    }
}

TEST_F(ReferenceOptions, OnlyTheLayersThatAreNamedAreWrittenTheFirstAlsoWithoutAName) {
    ASSERT_TRUE(
        quietSuccess(reference(cubes, {"--spp", "2", "--layers", "normal,depth", "-o", "some.exr", "-o", "some.png"})));
    Names names;
    std::ranges::transform(layers("some.exr"), std::back_inserter(names), &ImageLayer::name);
    EXPECT_EQ(names, (Names{"", "depth", "normal"}));  // as they are read: by name
    Images all = traced(cubes, {"--spp", "2"});
    Images some = images("some.exr");
    EXPECT_EQ(some["depth"].data, all["depth"].data);
    EXPECT_EQ(some[""].data, all["normal"].data);
}

TEST_F(ReferenceOptions, AmbientOcclusionHasARadiusAndAFalloff) {
    const auto visibility = [&](Arguments more) {
        more.insert(more.end(), {"--spp", "16", "--layers", "ambient_occlusion"});
        return mean(traced(cubes, more)["ambient_occlusion"]);
    };
    const float near = visibility({"--ao-radius", "0.3"});
    const float usual = visibility({});
    EXPECT_EQ(usual, visibility({"--ao-radius", "1", "--ao-falloff", "0"}));
    EXPECT_LT(near, 1.0F);
    EXPECT_LT(usual, near);
    EXPECT_GT(visibility({"--ao-falloff", "1"}), usual);
    EXPECT_GT(visibility({"--visible-only"}), usual);
}

TEST_F(ReferenceOptions, ANoiseThatIsReachedEndsEarlier) {
    const Outcome early = reference(cubes, {"--noise", "0.2", "--spp", "1000", "-o", "a.exr"});
    ASSERT_TRUE(quietSuccess(early));
    const int samples = std::stoi(early.out);
    EXPECT_GE(samples, 2);
    EXPECT_LT(samples, 1000);
    const std::string words = "noise ";
    EXPECT_LT(std::stod(early.out.substr(early.out.find(words) + words.size())), 0.2) << early.out;
    const Outcome same = reference(cubes, {"--spp", std::to_string(samples), "-o", "b.exr"});
    ASSERT_TRUE(quietSuccess(same));
    EXPECT_EQ(read("a.exr"), read("b.exr"));  // the samples do not depend on what ended the render
    const Outcome limited = reference(cubes, {"--noise", "0.0001", "--spp", "3", "-o", "a.exr"});
    EXPECT_TRUE(limited.out.starts_with("3 samples per pixel, ")) << limited.out;
}

TEST_F(ReferenceOptions, SamplesThroughThePixelsCentreSeeTheSilhouetteOfTheDepth) {
    for (const std::string filter : {"box", "center"}) {
        Images a = traced(tiltedCube, {"--spp", "16", "--filter", filter});
        size_t split = 0;  // pixels with background at the centre but a part of the cube, or vice versa
        for (size_t i = 0; i < a["depth"].data.size(); ++i) {
            const float depth = a["depth"].data[i];
            const float albedo = a["albedo"].data[3 * i];
            split += (depth > 0.0F) != (albedo > 0.0F) ? 1 : 0;
        }
        EXPECT_EQ(split == 0, filter == "center") << split;
    }
}

TEST_F(ReferenceOptions, DepthIsTheRenderers) {
    for (const std::string& scene : {cubes, tiltedCube}) {
        ASSERT_TRUE(quietSuccess(reference(scene, {"--spp", "1", "--filter", "center", "-o", "ref.exr"})));
        ASSERT_TRUE(quietSuccess(render(scene, {"-o", "render.exr", "--preset", "direct", "--aov", "depth"})));
        EXPECT_LT(relativeMse("ref.exr:depth", "render.exr:depth"), 1e-6) << scene;
    }
}

TEST_F(ReferenceOptions, UniformSamplingIsAnotherNoiseOfTheSamePicture) {
    Images cosine = traced(cubes, {"--spp", "256", "--sampling", "cosine"});
    Images uniform = traced(cubes, {"--spp", "256", "--sampling", "uniform"});
    EXPECT_NE(cosine["indirect_diffuse"].data, uniform["indirect_diffuse"].data);
    const float expected = mean(cosine["indirect_diffuse"]);
    EXPECT_NEAR(mean(uniform["indirect_diffuse"]), expected, 0.02F * expected);
    EXPECT_EQ(cosine["direct"].data, uniform["direct"].data);
}

TEST_F(ReferenceOptions, LambertOnlyHasNoSpecularLight) {
    EXPECT_GT(mean(traced(cubes, {"--spp", "2"})["indirect_specular"]), 0.0F);
    EXPECT_EQ(largest(traced(cubes, {"--spp", "2", "--set", "materials.lambert_only=true"})["indirect_specular"]),
              0.0F);
}

// Scene and view.

TEST_F(ReferenceOptions, ACameraIsChosenByNumberOrName) {
    EXPECT_EQ(bytes({"--camera", "1"}), bytes({"--camera", "side"}));
    EXPECT_NE(bytes({"--camera", "1"}), bytes({"--camera", "main"}));
}

TEST_F(ReferenceOptions, AViewFileChangesCameraSunAndEnvironmentAsItDoesForTheRenderer) {
    write("v.json", R"({"camera": {"position": [1, 2, 7], "target": [0, 0, 0], "fov_y": 50},
                        "sun": {"irradiance": [0, 0, 0]}, "environment": {"radiance": [0, 0, 2]}})");
    Images a = traced(tiltedCube, {"--view-file", "v.json", "--spp", "4"});
    EXPECT_EQ(std::vector<float>(a["direct"].data.begin(), a["direct"].data.begin() + 3),
              (std::vector<float>{0, 0, 2}));
    EXPECT_NE(a["depth"].data, traced(tiltedCube, {"--spp", "1"})["depth"].data);
    ASSERT_TRUE(quietSuccess(reference(tiltedCube, {"--view-file", "v.json", "--spp", "1", "-o", "ref.exr"})));
    ASSERT_TRUE(quietSuccess(
        render(tiltedCube, {"--view-file", "v.json", "-o", "render.exr", "--preset", "direct", "--aov", "depth"})));
    EXPECT_LT(relativeMse("ref.exr:depth", "render.exr:depth"), 1e-6);
    write("dark.json", R"({"sun": {"irradiance": [0, 0, 0]}, "environment": {"radiance": [0, 0, 0]}})");
    EXPECT_EQ(largest(traced(tiltedCube, {"--view-file", "dark.json", "--spp", "2"})[""]), 0.0F);
}

TEST_F(ReferenceOptions, AWideSunHasPenumbrasAndAPointHasNone) {
    const auto visibility = [&](const std::string& diameter) {
        write("v.json", R"({"sun": {"angular_diameter": )" + diameter + "}}");
        return traced(cubes, {"--view-file", "v.json", "--spp", "16", "--filter", "center"})["sun_visibility"];
    };
    EXPECT_EQ(between(visibility("0")), 0);
    EXPECT_GT(between(visibility("30")), 10);
}

TEST_F(ReferenceOptions, AnEnvironmentImageShinesHereAndInTheRenderer) {
    // One texel, 1 in all channels.
    write("sky.hdr", std::string("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 1\n") + "\x80\x80\x80\x81");
    write("image.json", R"({"sun": {"irradiance": [0, 0, 0]}, "environment": {"image": "sky.hdr", "intensity": 3}})");
    write("plain.json", R"({"sun": {"irradiance": [0, 0, 0]}, "environment": {"radiance": [3, 3, 3]}})");
    Images image = traced(tiltedCube, {"--view-file", "image.json", "--spp", "256"});
    Images plain = traced(tiltedCube, {"--view-file", "plain.json", "--spp", "256"});
    EXPECT_EQ(image["direct"].data.front(), 3.0F);  // the background
    EXPECT_EQ(image["direct"].data, plain["direct"].data);
    const float expected = mean(plain["indirect_diffuse"]);
    EXPECT_GT(expected, 0.01F);
    EXPECT_NEAR(mean(image["indirect_diffuse"]), expected, 0.02F * expected);
    ASSERT_TRUE(quietSuccess(render(tiltedCube, {"--view-file", "image.json", "-o", "image.exr", "--aov", "direct"})));
    ASSERT_TRUE(quietSuccess(render(tiltedCube, {"--view-file", "plain.json", "-o", "plain.exr", "--aov", "direct"})));
    EXPECT_EQ(relativeMse("image.exr", "plain.exr"), 0.0);
    EXPECT_EQ(relativeMse("image.exr:direct", "plain.exr:direct"), 0.0);
}

TEST_F(ReferenceOptions, NoVulkanDeviceIsNeeded) {
    EXPECT_TRUE(
        quietSuccess(run(arguments(cubes, {"--spp", "1", "-o", "a.exr", "-o", "a.png"}),
                         {{"VK_ICD_FILENAMES", "/nowhere/none.json"}, {"VK_DRIVER_FILES", "/nowhere/none.json"}})));
}

}  // namespace
}  // namespace reflet::reference_options_test
