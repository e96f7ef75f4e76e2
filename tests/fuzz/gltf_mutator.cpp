// Structural mutations of glTF documents.
#include "gltf_mutator.h"

#include "base/json_text.h"
#include "fuzz.h"

#include <array>
#include <utility>
#include <vector>

namespace reflet::fuzz {

namespace {

using nlohmann::json;

constexpr size_t mostCopies = 64;
constexpr size_t largestDocument = 1UL << 20;  // a document that is copied into itself grows

size_t below(std::mt19937& random, size_t end) {
    return end == 0 ? 0 : random() % end;
}

size_t wordAt(std::string_view bytes, size_t at) {
    size_t value = 0;
    for (size_t i = 4; i-- > 0;) {
        value = value << 8U | static_cast<uint8_t>(bytes[at + i]);
    }
    return value;
}

/// All values of the document, parents before children.
void collect(json& value, std::vector<json*>& all) {
    all.push_back(&value);
    for (json& child : value) {
        if (value.is_structured()) {
            collect(child, all);
        }
    }
}

json boundaryNumber(std::mt19937& random) {
    static const std::array<json, 30> numbers{0,
                                              1,
                                              2,
                                              3,
                                              4,
                                              -1,
                                              127,
                                              128,
                                              255,
                                              256,
                                              65535,
                                              65536,
                                              2147483647,
                                              2147483648U,
                                              -2147483648LL,
                                              4294967295U,
                                              4294967296ULL,
                                              9007199254740992ULL,
                                              9223372036854775807LL,
                                              18446744073709551615ULL,
                                              0.5,
                                              -0.0,
                                              1e-40,
                                              1e-300,
                                              1e10,
                                              1e18,
                                              3.5e38,
                                              -1e300,
                                              1e308,
                                              -1e-7};
    return numbers.at(below(random, numbers.size()));
}

json enumerator(std::mt19937& random) {  // component types, modes, filters, wrapping
    static const std::array<int, 18> values{5120, 5121, 5122, 5123, 5124,  5125,  5126,  5130,  9728,
                                            9729, 9984, 9985, 9986, 33071, 33648, 10497, 34962, 34963};
    return values.at(below(random, values.size()));
}

json anyText(std::mt19937& random) {
    static const std::array<const char*, 36> texts{"",
                                                   "NaN",
                                                   "Infinity",
                                                   "-1",
                                                   "2.0",
                                                   "SCALAR",
                                                   "VEC2",
                                                   "VEC3",
                                                   "VEC4",
                                                   "MAT2",
                                                   "MAT4",
                                                   "POSITION",
                                                   "NORMAL",
                                                   "JOINTS_0",
                                                   "translation",
                                                   "rotation",
                                                   "weights",
                                                   "LINEAR",
                                                   "STEP",
                                                   "CUBICSPLINE",
                                                   "BLEND",
                                                   "MASK",
                                                   "orthographic",
                                                   "perspective",
                                                   "directional",
                                                   "point",
                                                   "spot",
                                                   "data:,",
                                                   "data:;base64,AAAA",
                                                   "../x",
                                                   "%00",
                                                   "image/webp",
                                                   "ATTRIBUTES",
                                                   "TRIANGLES",
                                                   "OCTAHEDRAL",
                                                   "KHR_draco_mesh_compression"};
    return texts.at(below(random, texts.size()));
}

json anyValue(std::mt19937& random) {
    switch (below(random, 7)) {
        case 0:
            return nullptr;
        case 1:
            return below(random, 2) == 0;
        case 2:
            return json::array();
        case 3:
            return json::object();
        case 4:
            return anyText(random);
        default:
            return boundaryNumber(random);
    }
}

json changedNumber(const json& value, std::mt19937& random) {
    switch (below(random, 6)) {
        case 0:
            return boundaryNumber(random);
        case 1:
            return enumerator(random);
        case 2:
            return below(random, 8);
        case 3:
            return value.is_number_integer() ? json(value.get<uint64_t>() ^ 1ULL << below(random, 64))
                                             : json(value.get<double>() * -1.0);
        case 4:
            return value.is_number_integer() ? json(value.get<uint64_t>() + 1) : json(value.get<double>() * 1e20);
        default:
            return value.is_number_integer() ? json(value.get<int64_t>() / 2) : json(value.get<double>() * 0.5);
    }
}

json changedText(const json& value, std::mt19937& random) {
    std::string text = value.get<std::string>();
    switch (text.empty() ? 0 : below(random, 4)) {
        case 0:
            return anyText(random);
        case 1:
            text[below(random, text.size())] = static_cast<char>(32 + below(random, 95));
            return text;
        case 2:
            return text.substr(0, below(random, text.size()));
        default:
            return text + text.substr(below(random, text.size()));
    }
}

void eraseFrom(json& parent, std::mt19937& random) {
    auto child = parent.begin();
    std::advance(child, static_cast<std::ptrdiff_t>(below(random, parent.size())));
    parent.erase(child);
}

/// Elements are copied within their array, members get the key of another one.
void duplicateIn(json& parent, std::mt19937& random) {
    auto child = parent.begin();
    std::advance(child, static_cast<std::ptrdiff_t>(below(random, parent.size())));
    const json copy = *child;
    if (parent.is_object()) {
        auto other = parent.begin();
        std::advance(other, static_cast<std::ptrdiff_t>(below(random, parent.size())));
        *other = copy;
        return;
    }
    const size_t copies = below(random, 8) == 0 ? 1 + below(random, mostCopies) : 1;
    for (size_t i = 0; i < copies; ++i) {
        parent.insert(parent.begin() + static_cast<std::ptrdiff_t>(below(random, parent.size() + 1)), copy);
    }
}

/// A member of another object, or an element of another array.
void adopt(json& parent, const json& from, std::mt19937& random) {
    if (from.empty() || from.type() != parent.type()) {
        return;
    }
    auto child = from.begin();
    std::advance(child, static_cast<std::ptrdiff_t>(below(random, from.size())));
    const json copy = *child;  // `from` may be a part of `parent`
    if (parent.is_object()) {
        const std::string key = child.key();
        parent[key] = copy;
    } else {
        parent.push_back(copy);
    }
}

void mutateStructure(json& value, const json& other, std::mt19937& random) {
    switch (value.empty() ? 2 : below(random, 4)) {
        case 0:
            eraseFrom(value, random);
            break;
        case 1:
            duplicateIn(value, random);
            break;
        case 2:
            adopt(value, json(other), random);
            break;
        default:
            value = anyValue(random);
    }
}

void mutateOnce(json& document, std::mt19937& random) {
    std::vector<json*> all;
    collect(document, all);
    json& value = *all[below(random, all.size())];
    json& other = *all[below(random, all.size())];
    const size_t kind = below(random, 16);
    if (kind == 0) {
        value = json(other);  // a copy first: one may be a part of the other
    } else if (kind == 1 && !value.is_structured() && !other.is_structured()) {
        std::swap(value, other);
    } else if (kind == 2 && &value != &document) {
        value = anyValue(random);
    } else if (value.is_number()) {
        value = changedNumber(value, random);
    } else if (value.is_string()) {
        value = changedText(value, random);
    } else if (value.is_boolean()) {
        value = !value.get<bool>();
    } else if (value.is_structured() && &value != &document) {
        mutateStructure(value, other, random);
    } else {
        adopt(document, json(other), random);
    }
}

}  // namespace

std::optional<GltfParts> gltfParts(std::string_view file) {
    GltfParts parts;
    std::string_view text = file;
    constexpr size_t heads = 20;
    if (file.starts_with("glTF")) {
        if (file.size() < heads) {
            return std::nullopt;
        }
        const size_t length = std::min(wordAt(file, 12), file.size() - heads);
        text = file.substr(heads, length);
        const std::string_view rest = file.substr(heads + length);
        parts.bin = rest.size() > 8 ? rest.substr(8) : "";
        parts.glb = true;
    }
    if (text.size() > largestDocument || !jsonExcess(text).empty()) {
        return std::nullopt;
    }
    parts.document = parseJsonIfValid(text);
    return parts.document.is_object() ? std::optional(std::move(parts)) : std::nullopt;
}

std::string gltfFile(const GltfParts& parts) {
    std::string text = jsonText(parts.document);
    if (!parts.glb) {
        return text;
    }
    text.resize((text.size() + 3) / 4 * 4, ' ');
    std::string chunk = parts.bin;
    chunk.resize((chunk.size() + 3) / 4 * 4, '\0');
    std::string file = "glTF";
    appendWord(file, 2);
    appendWord(file, 20 + text.size() + (chunk.empty() ? 0 : 8 + chunk.size()));
    appendWord(file, text.size());
    file += "JSON" + text;
    if (!chunk.empty()) {
        appendWord(file, chunk.size());
        file += std::string("BIN\0", 4) + chunk;
    }
    return file;
}

void mutateDocument(json& document, std::mt19937& random) {
    const size_t times = below(random, 4) == 0 ? 1 + below(random, 4) : 1;
    for (size_t i = 0; i < times; ++i) {
        mutateOnce(document, random);
    }
}

}  // namespace reflet::fuzz
