// Search in the settings panel.
#include "view/setting_search.h"

#include "base/ascii.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

namespace reflet {

namespace {

// What people call the settings that begin so, in words that names and help may lack.
constexpr std::pair<std::string_view, std::string_view> synonyms[] = {
    {"materials.", "texture material surface"},
    {"depth.", "depth z buffer precision reversed"},
    {"shadow.", "shadow soft penumbra shadow-map sun light"},
    {"shadow.cascade", "csm cascaded"},
    {"shadow.denoise", "blur filter noise"},
    {"contact.", "contact shadow screen-space sss"},
    {"direct.", "tiled culling lights lighting"},
    {"trace_screen.", "ssr ssgi reflection indirect screen-space ray march raymarch hi-z hierarchical raytracing"},
    {"trace_scene.", "reflection indirect ray tracing raytracing rtx bvh triangles fallback hardware"},
    {"probes.", "reflection indirect probe cubemap cube-map ibl fallback gi"},
    {"planar.", "reflection mirror planar"},
    {"live.", "monitor render-to-texture camera"},
    {"environment.", "sky ibl hdri background ambient reflection indirect"},
    {"diffuse.", "ssgi gi global illumination indirect bounce spp samples"},
    {"diffuse.downsample", "half resolution half-res upsampling scale"},
    {"specular.", "ssr reflection glossy mirror indirect spp samples"},
    {"specular.downsample", "half resolution half-res upsampling scale"},
    {"denoise.", "blur filter noise reflection indirect spatiotemporal svgf"},
    {"denoise.history", "temporal accumulation ghosting"},
    {"denoise.clip", "ghosting trail"},
    {"accumulate.", "progressive mean samples converge"},
    {"temporal.", "taa antialiasing anti-aliasing aa jitter ghosting flicker blur"},
    {"tonemap.", "tone mapping brightness hdr exposure display"},
};

bool isLetter(char c) {
    return isAsciiAlphanumeric(c);
}

// "gi" begins a word of "one GI ray", and none of "original".
bool beginsAWord(const std::string& text, const std::string& word) {
    for (size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) {
        if (at == 0 || !isLetter(text[at - 1])) {
            return true;
        }
    }
    return false;
}

std::vector<std::string> wordsOf(std::string_view text) {
    std::vector<std::string> words;
    std::string word;
    for (const char c : inLowerCase(std::string(text)) + " ") {
        if (c != ' ') {
            word += c;
        } else if (!word.empty()) {
            words.push_back(std::exchange(word, ""));
        }
    }
    return words;
}

}  // namespace

bool isFound(const SettingEntry& entry, std::string_view typed) {
    std::string text = inLowerCase(std::string(entry.info.help));
    for (const auto& [begin, terms] : synonyms) {
        if (entry.name.starts_with(begin)) {
            text += " ";
            text += terms;
        }
    }
    return std::ranges::all_of(wordsOf(typed), [&](const std::string& word) {
        return entry.name.find(word) != std::string::npos || beginsAWord(text, word);
    });
}

}  // namespace reflet
