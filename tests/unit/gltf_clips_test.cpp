// Which animations of a glTF file play, by default and by name or number.
#include "gltf_builder.h"

#include <gtest/gtest.h>

#include <initializer_list>

namespace reflet::test::gltf_clips_test {
namespace {

using nlohmann::json;

json clip(const GltfBuilder& builder, const char* name, std::initializer_list<std::pair<int, const char*>> targets) {
    json animation = builder.document["animations"][0];
    const json channel = animation["channels"][0];
    animation["name"] = name;
    animation["channels"] = json::array();
    for (const auto& [node, path] : targets) {
        animation["channels"].push_back(channel);
        animation["channels"].back()["target"] = {{"node", node}, {"path", path}};
    }
    return animation;
}

// Clips of one thing, of another, of both, and of another property of the first.
GltfBuilder severalClips() {
    GltfBuilder b = slider();
    const int other = b.add("nodes", {{"name", "other"}, {"mesh", 0}});
    b.document["scenes"][0]["nodes"].push_back(other);
    json& all = b.document["animations"];
    const json clips{clip(b, "walk", {{0, "translation"}}), clip(b, "run", {{0, "translation"}}),
                     clip(b, "other", {{other, "translation"}}),
                     clip(b, "both", {{0, "scale"}, {other, "translation"}}), clip(b, "3", {{0, "scale"}})};
    all = clips;
    return b;
}

std::vector<std::string> playing(GltfBuilder builder, const std::string& wanted) {
    const Scene scene =
        loadGltf(builder.writeGltf(testFolder() / "clips.gltf"), {.animation = wanted, .warn = nullptr});
    EXPECT_EQ(scene.clips.size(), 5U) << "all are known";
    std::vector<std::string> names;
    for (const AnimationClip& clip : scene.clips) {
        if (clip.plays) {
            names.push_back(clip.name);
        }
    }
    EXPECT_EQ(scene.animations.size(), names.size());
    for (size_t i = 0; i < std::min(names.size(), scene.animations.size()); ++i) {
        EXPECT_EQ(scene.animations[i].name, names[i]);
    }
    return names;
}

using Names = std::vector<std::string>;

TEST(GltfClips, EachPlaysThatMovesNothingOfAnEarlierOne) {
    EXPECT_EQ(playing(severalClips(), ""), (Names{"walk", "other", "3"}));
}

TEST(GltfClips, OneIsChosenByNameOrByNumber) {
    EXPECT_EQ(playing(severalClips(), "run"), Names{"run"});
    EXPECT_EQ(playing(severalClips(), "1"), Names{"run"});
    EXPECT_EQ(playing(severalClips(), "3"), Names{"3"}) << "the name before the number";
    EXPECT_EQ(playing(severalClips(), "none"), Names{});
    EXPECT_EQ(playing(severalClips(), "all"), (Names{"walk", "run", "other", "both", "3"}));
}

TEST(GltfClips, AnUnknownOneIsRefusedWithTheNames) {
    for (const char* wanted : {"jump", "5", "-1", "1x"}) {
        try {
            playing(severalClips(), wanted);
            ADD_FAILURE() << wanted;
        } catch (const UsageError& error) {
            const std::string text = error.what();
            EXPECT_NE(text.find(wanted), std::string::npos) << text;
            EXPECT_NE(text.find("walk, run, other, both, 3"), std::string::npos) << text;
        }
    }
}

TEST(GltfClips, TheirLengthIsThatOfTheirLastKey) {
    const Scene scene = loadGltf(severalClips().writeGltf(testFolder() / "clips.gltf"));
    for (const AnimationClip& clip : scene.clips) {
        EXPECT_EQ(clip.seconds, scene.animations[0].channels[0].times.back());
    }
}

}  // namespace
}  // namespace reflet::test::gltf_clips_test
