// Images, one target for each format: a format's mutations are no use to the others, and each has a corpus of its own.
// PNG, JPEG, WebP and KTX 2 are textures of scenes; `reflet compare` reads PNG and JPEG, too; HDR and EXR are
// environments. REFLET_FUZZ_IMAGE names the target of a libFuzzer program.
#include "scene/gltf/image.h"
#include "base/image_file.h"
#include "fixed_scene.h"
#include "scene/environment.h"
#include "targets.h"

namespace {

using namespace reflet;

/// As a texture.
int decodeTexture(const uint8_t* bytes, size_t size) {
    return fuzz::survive([&] {
        GltfDocument document = fuzz::documentOf(bytes, size);
        tinygltf::Image image;
        image.bufferView = 0;
        document.model.images.push_back(image);
        GltfReport report("scene.glb", {}, true);
        (void)gltfImageIsBasis(document, 0, report);
        const TextureImage decoded = decodeGltfImage(document, 0, report);
        if (decoded.rgba.size() != size_t{4} * decoded.width * decoded.height) {
            fuzz::finding("an image without all of its texels");
        }
    });
}

int readDisplay(const char* name, const uint8_t* bytes, size_t size) {
    return fuzz::survive([&] { (void)readBitmap(fuzz::file(name, bytes, size)); });
}

}  // namespace

int reflet::fuzz::png(const uint8_t* bytes, size_t size) {
    decodeTexture(bytes, size);
    return readDisplay("image.png", bytes, size);
}

int reflet::fuzz::jpeg(const uint8_t* bytes, size_t size) {
    decodeTexture(bytes, size);
    return readDisplay("image.jpg", bytes, size);
}

int reflet::fuzz::webp(const uint8_t* bytes, size_t size) {
    return decodeTexture(bytes, size);
}

int reflet::fuzz::ktx2(const uint8_t* bytes, size_t size) {
    return decodeTexture(bytes, size);
}

int reflet::fuzz::hdr(const uint8_t* bytes, size_t size) {
    return survive([&] { (void)readEnvironmentImage(file("image.hdr", bytes, size)); });
}

int reflet::fuzz::exr(const uint8_t* bytes, size_t size) {
    const auto path = file("image.exr", bytes, size);
    survive([&] { (void)readExr(path); });
    return survive([&] { (void)readEnvironmentImage(path); });
}

#ifdef REFLET_FUZZ_IMAGE
FUZZ_ENTRY(REFLET_FUZZ_IMAGE)
#endif
