// Camera paths.
#include "scene/camera_path.h"
#include "fuzz.h"

FUZZ_TARGET(cameraPath) {
    return survive([&] {
        const CameraPath path = loadCameraPath(file("path.json", bytes, size), Camera{});
        for (const double time : {0.0, 0.5, 1e6}) {
            (void)path.at(time);
        }
    });
}
