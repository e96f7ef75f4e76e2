// Images outside of scenes: environments and what `reflet compare` reads.
#include "base/image_file.h"
#include "fuzz.h"
#include "scene/environment.h"

using namespace reflet;

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* bytes, size_t size) {
    fuzz::survive([&] { (void)readEnvironmentImage(fuzz::file("image.hdr", bytes, size)); });
    fuzz::survive([&] { (void)readEnvironmentImage(fuzz::file("image.exr", bytes, size)); });
    return fuzz::survive([&] { (void)readBitmap(fuzz::file("image.png", bytes, size)); });
}
