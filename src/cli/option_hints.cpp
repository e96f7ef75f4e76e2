// The table of options that other programs have.
#include "cli/option_hints.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace reflet {

namespace {

struct Hint {
    std::string_view typed;
    std::string_view option;  ///< that the command must have; "": it is said to any command
    std::string_view use;
};

// Of several hints for one word, the first whose option the command has.
constexpr std::array hints{
    Hint{"--camera-orbit", "--orbit", "--orbit AZ,EL[,DISTANCE]"},
    Hint{"--azimuth", "--orbit", "--orbit AZ,EL"},
    Hint{"--elevation", "--orbit", "--orbit AZ,EL"},
    Hint{"--distance", "--orbit", "--orbit AZ,EL,DISTANCE"},
    Hint{"--rotate", "--orbit", "--orbit AZ,EL"},
    Hint{"--camera-target", "--look-at", "--look-at X,Y,Z or a node's name"},
    Hint{"--target", "--look-at", "--look-at X,Y,Z or a node's name"},
    Hint{"--lookat", "--look-at", "--look-at X,Y,Z or a node's name"},
    Hint{"--camera-position", "--view-file", "--orbit AZ,EL,DISTANCE, or a camera's position in a --view-file"},
    Hint{"--position", "--view-file", "--orbit AZ,EL,DISTANCE, or a camera's position in a --view-file"},
    Hint{"--eye", "--view-file", "--orbit AZ,EL,DISTANCE, or a camera's position in a --view-file"},
    Hint{"--field-of-view", "--fov", "--fov DEGREES"},
    Hint{"--fov", "--view-file", "fov_y of the camera in a --view-file"},
    Hint{"--fovy", "--fov", "--fov DEGREES, which is vertical"},
    Hint{"--fov-y", "--fov", "--fov DEGREES, which is vertical"},
    Hint{"--yfov", "--fov", "--fov DEGREES, which is vertical"},
    Hint{"--focal-length", "--fov", "--fov DEGREES: a lens of F mm has 2 atan(12 / F)"},
    Hint{"--aperture", "--f-number", "--f-number N"},
    Hint{"--fstop", "--f-number", "--f-number N"},
    Hint{"--f-stop", "--f-number", "--f-number N"},
    Hint{"--focus-distance", "--focus", "--focus METRES"},
    Hint{"--sun-direction", "--sun", "--sun AZ,EL"},
    Hint{"--light", "--sun", "--sun AZ,EL or --environment sky|studio|none|FILE"},
    Hint{"--light-direction", "--sun", "--sun AZ,EL"},
    Hint{"--ev", "--exposure", "--exposure STOPS"},
    Hint{"--exposure", "--set", "--set tonemap.exposure=STOPS"},
    Hint{"--brightness", "--exposure", "--exposure STOPS"},
    Hint{"--tonemap", "--set", "--set tonemap.curve=NAME (reflet list settings tonemap)"},
    Hint{"--hdri", "--environment", "--environment FILE.hdr"},
    Hint{"--env", "--environment", "--environment sky|studio|none|FILE.hdr"},
    Hint{"--ibl", "--environment", "--environment FILE.hdr"},
    Hint{"--skybox", "--environment", "--environment FILE.hdr"},
    Hint{"--sky", "--environment", "--environment sky"},
    Hint{"--studio", "--environment", "--environment studio"},
    Hint{"--environment-map", "--environment", "--environment FILE.hdr"},
    Hint{"--bg", "--background", "--background COLOR"},
    Hint{"--background-color", "--background", "--background COLOR"},
    Hint{"--transparent", "--background", "--background transparent"},
    Hint{"--alpha", "--background", "--background transparent"},
    Hint{"--resolution", "--size", "--size WIDTHxHEIGHT"},
    Hint{"--res", "--size", "--size WIDTHxHEIGHT"},
    Hint{"--width", "--size", "--size WIDTHxHEIGHT"},
    Hint{"--height", "--size", "--size WIDTHxHEIGHT"},
    Hint{"--samples", "--spp", "--spp N"},
    Hint{"--quality", "--effort", "--effort draft|normal|high, or --preset quality"},
    Hint{"--quality", "--spp", "--spp N or --noise X"},
    Hint{"--quality", "--preset", "--preset quality (reflet list presets)"},
    Hint{"--spp", "--effort", "--effort high or --seconds N; rays per pixel are --set diffuse.rays=N"},
    Hint{"--samples", "--effort", "--effort high or --seconds N; rays per pixel are --set diffuse.rays=N"},
    Hint{"--time-limit", "--seconds", "--seconds N"},
    Hint{"--max-bounces", "--bounces", "--bounces N"},
    Hint{"--threshold", "--noise", "--noise X"},
    Hint{"--denoise", "--set", "--set denoise.enabled=true|false (reflet list settings denoise)"},
    Hint{"--hdr", "--output", "-o FILE.exr, which keeps all values"},
    Hint{"--exr", "--output", "-o FILE.exr"},
    Hint{"--png", "--output", "-o FILE.png"},
    Hint{"--format", "--output", "-o FILE with the ending of the format"},
    Hint{"--out", "--output", "-o FILE"},
    Hint{"--passes", "--aov", "--aov A,B,... (reflet list shows)"},
    Hint{"--layers", "--aov", "--aov A,B,... (reflet list shows)"},
    Hint{"--aov", "--layers", "--layers A,B,..."},
    Hint{"--turntable", "", "reflet turntable SCENE -o film.webp"},
    Hint{"--spin", "", "reflet turntable SCENE -o film.webp"},
    Hint{"--animate", "--frames", "--frames N -o film.webp"},
    Hint{"--frame", "--time", "--time SECONDS"},
    Hint{"--framerate", "--fps", "--fps F"},
    Hint{"--duration", "--seconds", "--seconds N"},
    Hint{"--duration", "--frames", "--frames N and --fps F"},
    Hint{"--force", "--overwrite", "--overwrite"},
    Hint{"--gpu", "--device", "--device NAME (reflet list devices)"},
    Hint{"--silent", "--quiet", "--quiet"},
    Hint{"--config", "--settings", "--settings F.json"},
};

struct Ending {
    std::string_view ending;
    std::string_view use;
};

constexpr std::array endings{Ending{".jpg", "JPEG is not written"},
                             Ending{".jpeg", "JPEG is not written"},
                             Ending{".gif", "use .webp, which loops and has all colours"},
                             Ending{".apng", "use .webp, which loops, too"},
                             Ending{".avi", "use .mp4"},
                             Ending{".mov", "use .mp4"},
                             Ending{".mkv", "use .webm"},
                             Ending{".hdr", "use .exr, which keeps all values"},
                             Ending{".tif", "use .exr, which keeps all values"},
                             Ending{".tiff", "use .exr, which keeps all values"}};

}  // namespace

std::string optionHint(std::string_view option, const std::function<bool(const std::string& name)>& has) {
    const std::string_view name = option.substr(0, option.find('='));
    for (const Hint& hint : hints) {
        if (hint.typed == name && (hint.option.empty() || has(std::string(hint.option)))) {
            return fmt::format("; use {}", hint.use);
        }
    }
    return "";
}

std::string endingHint(std::string_view ending) {
    const auto* found = std::ranges::find(endings, ending, &Ending::ending);
    return found == endings.end() ? "" : fmt::format("; {}", found->use);
}

}  // namespace reflet
