// A glTF scene around a payload that is fuzzed: the document is fixed, so that all mutations reach the payload's
// decoder.
#pragma once

#include "fuzz.h"
#include "scene/gltf/document.h"
#include "scene/gltf/gltf.h"

#include <cstring>
#include <limits>
#include <string>

namespace reflet::fuzz {

/// The payload as the only buffer of a document, and as its buffer view 0.
inline GltfDocument documentOf(const uint8_t* bytes, size_t size) {
    GltfDocument document;
    document.folder = folder();
    tinygltf::Buffer buffer;
    buffer.data.assign(bytes, bytes + size);
    document.model.buffers.push_back(std::move(buffer));
    tinygltf::BufferView view;
    view.buffer = 0;
    view.byteLength = size;
    document.model.bufferViews.push_back(std::move(view));
    return document;
}

/// Loads a .glb of this document and binary chunk. What the loader refuses is no finding.
inline void loadGlb(std::string json, std::string payload) {
    json.resize((json.size() + 3) / 4 * 4, ' ');
    payload.resize((payload.size() + 3) / 4 * 4, '\0');
    std::string glb = "glTF";
    appendWord(glb, 2);
    appendWord(glb, 28 + json.size() + payload.size());
    appendWord(glb, json.size());
    glb += "JSON" + json;
    appendWord(glb, payload.size());
    glb += std::string("BIN\0", 4) + payload;
    const auto path = file("payload.glb", glb.data(), glb.size());
    survive([&] { (void)loadGltf(path, {}); });
}

}  // namespace reflet::fuzz
