// Writes the files that fuzzing starts from: `fuzz_seeds FOLDER` makes a folder for each target.
#include "base/file.h"
#include "base/image_file.h"
#include "base/json_text.h"
#include "renderer/presets.h"
#include "scene/view_file.h"
#include "unit/gltf_encoders.h"
#include "view/saved_state.h"

#include <nlohmann/json.hpp>

#include <cstdio>

using namespace reflet;
namespace fs = std::filesystem;

namespace {

void writeSeeds(const fs::path& folder) {
    const auto write = [&](const std::string& target, const std::string& name, const std::string& content) {
        fs::create_directories(folder / target);
        writeFileAtomically(folder / target / name, content);
    };
    write("gltf", "everything.glb", test::everything().glbBytes());
    write("gltf", "everything.gltf", test::everything().gltfBytes());
    write("gltf", "slider.gltf", test::slider().gltfBytes());
    write("gltf", "bent.glb", test::bent().glbBytes());
    write("gltf", "morphing.glb", test::morphing().glbBytes());
    write("gltf", "compressed.glb", test::compressed().glbBytes());

    fs::create_directories(folder / "image");
    writePng(folder / "image/a.png", {4, 3, 4, std::vector<uint8_t>(48, 77)});
    writeExr(folder / "image/a.exr",
             std::vector<ImageLayer>{{"", {4, 3, {"R", "G", "B"}, std::vector<float>(36, 0.5F)}}});
    const std::string hdr = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n";
    const std::string line("\x02\x02\x00\x08\x08\x80\x02\x03\x04\x05\x06\x07\x80\x88\x40\x88\x00\x83\x81\x85\x81", 21);
    write("image", "runs.hdr", hdr + "-Y 2 +X 8\n" + line + line);
    write("image", "plain.hdr", hdr + "-Y 1 +X 2\n\x80\x40\x20\x81\x80\x40\x20\x81");

    View view;
    view.lampRadius = 0.1F;
    view.probes = {Probe{}};
    write("view_file", "view.json", jsonText(viewJson(view), 2));
    write("camera_path", "path.json",
          R"({"keyframes": [{"time": 0, "position": [0, 0, 5], "target": [0, 0, 0]},
                            {"time": 1, "position": [5, 0, 0], "target": [0, 0, 0], "fov_y": 30}], "loop": false})");
    Settings preset;
    applyPreset(preset, "quality");
    write("settings", "settings.json", jsonText(settingsJson(preset, Settings{}), 2));
    write("sequence_record", "record.json",
          R"({"device": "d", "size": [2, 3], "view": {"time": 1}, "settings": {"diffuse.rays": "4"}})");
    ViewerState state;
    state.source.scene = "builtin:cubes";
    state.preset = "plain";
    write("saved_state", "state.json", stateText(state));
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 2) {
        std::fputs("usage: fuzz_seeds FOLDER\n", stderr);
        return 2;
    }
    writeSeeds(argv[1]);
    return 0;
}
