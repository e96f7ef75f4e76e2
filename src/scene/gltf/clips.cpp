#include "scene/gltf/clips.h"

#include "base/error.h"
#include "base/message.h"
#include "scene/gltf/accessor.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <set>
#include <tuple>

namespace reflet {

namespace {

// What a channel moves: a path of a node, or a pointer.
using Target = std::tuple<int, std::string, std::string>;

Target targetOf(const tinygltf::AnimationChannel& channel) {
    const auto extension = channel.target_extensions.find("KHR_animation_pointer");
    const bool pointer = extension != channel.target_extensions.end() && extension->second.Has("pointer") &&
                         extension->second.Get("pointer").IsString();
    return {channel.target_node, channel.target_path,
            pointer ? extension->second.Get("pointer").Get<std::string>() : std::string()};
}

// 0 if the accessor has no such time; who plays the animation says what is wrong with it.
float lastTime(const GltfDocument& document, int input, GltfReport& report) {
    if (input < 0) {
        return 0.0F;
    }
    try {
        const AccessorView times = viewAccessor(document, input, report);
        const float last = times.count > 0 ? times.at(times.count - 1).x : 0.0F;
        return std::isfinite(last) ? last : 0.0F;
    } catch (const Error&) {
        return 0.0F;
    }
}

AnimationClip clipOf(const GltfDocument& document, const tinygltf::Animation& animation, GltfReport& report) {
    AnimationClip clip{.name = animation.name, .channels = animation.channels.size()};
    for (const tinygltf::AnimationSampler& sampler : animation.samplers) {
        clip.seconds = std::max(clip.seconds, lastTime(document, sampler.input, report));
    }
    return clip;
}

std::optional<size_t> numberIn(const std::string& text) {
    size_t number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    return error == std::errc() && end == text.data() + text.size() ? std::optional(number) : std::nullopt;
}

// Those that move nothing of what an earlier one moves.
void playUnlike(const GltfDocument& document, std::vector<AnimationClip>& clips) {
    std::set<Target> moved;
    auto clip = clips.begin();
    for (const auto& [index, animation] : document.animations) {
        const auto& channels = animation.channels;
        clip->plays = std::ranges::none_of(channels, [&](const auto& c) { return moved.contains(targetOf(c)); });
        if (clip++->plays) {
            std::ranges::for_each(channels, [&](const auto& c) { moved.insert(targetOf(c)); });
        }
    }
}

// The one of this name, else of this number in the file.
AnimationClip* findClip(const GltfDocument& document, std::vector<AnimationClip>& clips, const std::string& wanted) {
    const auto named = std::ranges::find(clips, wanted, &AnimationClip::name);
    if (named != clips.end()) {
        return &*named;
    }
    const std::optional<size_t> number = numberIn(wanted);
    const auto found = number ? document.animations.find(*number) : document.animations.end();
    return found == document.animations.end()
               ? nullptr
               : &clips[static_cast<size_t>(std::distance(document.animations.begin(), found))];
}

[[noreturn]] void refuse(const std::vector<AnimationClip>& clips, const std::string& wanted, const GltfReport& report) {
    std::vector<std::string> names;
    std::ranges::transform(clips, std::back_inserter(names), &AnimationClip::name);
    report.failUsage("", "there is no animation '{}'; the file's animations: {}", wanted,
                     names.empty() ? "none" : listed(names));
}

}  // namespace

std::vector<AnimationClip> chooseGltfAnimations(GltfDocument& document, const std::string& wanted, GltfReport& report) {
    std::vector<AnimationClip> clips;
    for (const auto& [index, animation] : document.animations) {
        clips.push_back(clipOf(document, animation, report));
    }
    if (wanted.empty()) {
        playUnlike(document, clips);
    } else if (AnimationClip* chosen = findClip(document, clips, wanted)) {
        chosen->plays = true;
    } else if (wanted == "all") {
        std::ranges::for_each(clips, [](AnimationClip& clip) { clip.plays = true; });
    } else if (wanted != "none") {
        refuse(clips, wanted, report);
    }
    auto clip = clips.begin();
    std::erase_if(document.animations, [&](const auto&) { return !clip++->plays; });
    return clips;
}

}  // namespace reflet
