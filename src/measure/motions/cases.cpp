#include "measure/motions/cases.h"

#include "base/error.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <iterator>

namespace reflet {

namespace {

constexpr double framesPerSecond = 24.0;
constexpr uint32_t framesToStop = 5;
constexpr uint32_t framesToReturn = 7;

vec3 turnedAboutY(const vec3& v, float degrees) {
    return vec3(glm::rotate(mat4(1.0F), glm::radians(degrees), vec3(0, 1, 0)) * vec4(v, 0.0F));
}

View pan(View view, float degrees) {
    view.camera.target = view.camera.position + turnedAboutY(view.camera.target - view.camera.position, degrees);
    return view;
}

View panBy5(const View& first, uint32_t frame) {
    return pan(first, 5.0F * static_cast<float>(frame));
}

View panBy15(const View& first, uint32_t frame) {
    return pan(first, 15.0F * static_cast<float>(frame));
}

// Animations play; nothing else changes.
View play(const View& first, uint32_t frame) {
    View view = first;
    view.time = frame / framesPerSecond;
    return view;
}

// The camera moves sideways by 6 cm a frame while animations play.
View strafe(const View& first, uint32_t frame) {
    View view = play(first, frame);
    const vec3 right = glm::normalize(glm::cross(first.camera.target - first.camera.position, first.camera.up));
    const vec3 moved = 0.06F * static_cast<float>(frame) * right;
    view.camera.position += moved;
    view.camera.target += moved;
    return view;
}

View turnSun(const View& first, uint32_t frame) {
    View view = first;
    view.sun.direction = turnedAboutY(first.sun.direction, 4.0F * static_cast<float>(frame));
    return view;
}

View switchOff(const View& first, uint32_t frame) {
    View view = first;
    if (frame > 0) {
        view.lampsOff = {0};
    }
    return view;
}

View switchOn(const View& first, uint32_t frame) {
    View view = first;
    if (frame == 0) {
        view.lampsOff = {0};
    }
    return view;
}

View cut(const View& first, uint32_t frame) {
    return pan(first, frame > 0 ? 150.0F : 0.0F);
}

// Cuts to what is behind the camera, and back.
View lookBack(const View& first, uint32_t frame) {
    return pan(first, frame > 0 && frame < framesToReturn ? 150.0F : 0.0F);
}

View stop(const View& first, uint32_t frame) {
    return panBy5(first, std::min(frame, framesToStop - 1));
}

using Lag = MotionCase::Lag;

constexpr std::array<MotionCase, 17> cases{{
    {"pan-5", "the camera turns by 5 degrees a frame", "motion-room", 12, panBy5, 2.0},
    {"pan-15", "the camera turns by 15 degrees a frame", "motion-room", 12, panBy15, 2.0},
    {"rods", "the camera passes thin rods: disocclusion", "motion-rods", 12, strafe},
    {"leaves", "the camera passes swinging alpha-tested leaves", "motion-leaves", 12, strafe},
    {"mirror", "a planar mirror turns by 3 degrees a frame", "motion-mirror", 12, play},
    {"lamp", "a lamp moves past posts, 13 cm a frame", "motion-lamp", 12, play},
    {"sun", "the sun turns by 4 degrees a frame", "motion-room", 12, turnSun},
    {"lamp-off", "a lamp is switched off", "motion-lamp-off", 12, switchOff, 1.5, Lag::light},
    {"lamp-on", "a lamp is switched on", "motion-lamp-off", 12, switchOn, 1.5, Lag::light},
    {"figures", "a skinned figure bends, a morphed one stretches", "motion-figures", 12, play},
    {"instances", "a carousel of instances turns by 7.5 degrees a frame", "motion-instances", 12, play},
    {"glass", "a ball and a pane of glass slide by 10 cm a frame", "motion-glass", 12, play},
    {"blended", "an alpha-blended pane slides by 10 cm a frame before a ball that slides against it", "motion-blended",
     12, play},
    {"blended-pan", "the camera passes both", "motion-blended", 12, strafe},
    {"cut", "the camera looks elsewhere from one frame to the next", "motion-room", 12, cut, 1.5, Lag::rest},
    {"look-back", "the camera looks elsewhere for six frames, and back", "motion-room", 18, lookBack, 1.5, Lag::rest,
     framesToReturn},
    {"stop", "the camera turns by 5 degrees a frame and stops", "motion-room", 16, stop, 1.5, Lag::rest, framesToStop},
}};

}  // namespace

std::span<const MotionCase> motionCases() {
    return cases;
}

std::vector<MotionCase> findMotionCases(const std::vector<std::string>& names) {
    if (names == std::vector<std::string>{"all"}) {
        return {cases.begin(), cases.end()};
    }
    std::vector<MotionCase> found;
    for (const std::string& name : names) {
        const auto* known = std::ranges::find(cases, name, &MotionCase::name);
        if (known == cases.end()) {
            std::vector<std::string> all{"all"};
            std::ranges::transform(cases, std::back_inserter(all),
                                   [](const MotionCase& c) { return std::string(c.name); });
            failUsage("--motions: no case is called '{}'; there are {}", name, fmt::join(all, ", "));
        }
        if (std::ranges::find(found, known->name, &MotionCase::name) == found.end()) {
            found.push_back(*known);
        }
    }
    return found;
}

}  // namespace reflet
