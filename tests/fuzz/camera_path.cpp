// Camera paths.
#include "scene/camera_path.h"
#include "fuzz.h"

using namespace reflet;

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* bytes, size_t size) {
    return fuzz::survive([&] {
        const CameraPath path = loadCameraPath(fuzz::file("path.json", bytes, size), Camera{});
        for (const double time : {0.0, 0.5, 1e6}) {
            (void)path.at(time);
        }
    });
}
