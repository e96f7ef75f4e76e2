// The fields of the C API's structs, and what is wrong in them.
#include "api_fields.h"

namespace reflet::fuzz {

#define REFLET_FIELD(type, member, kind)                              \
    Field {                                                           \
        offsetof(type, member), sizeof(type::member), FieldKind::kind \
    }
#define REFLET_FIELDS(type, ...)                         \
    std::span<const Field> fieldsOf(const type&) {       \
        using T = type;                                  \
        static constexpr Field fields[] = {__VA_ARGS__}; \
        return fields;                                   \
    }
#define F(member, kind) REFLET_FIELD(T, member, kind)

REFLET_FIELDS(RefletContextInfo, F(structSize, size), F(version, words), F(instance, pointer),
              F(physicalDevice, pointer), F(device, pointer), F(getInstanceProcAddr, pointer),
              F(enabledFeatures, pointer), F(enabledExtensions, pointer), F(pipelineCacheDataSize, count),
              F(pipelineCacheData, pointer), F(memory, pointer), F(log, pointer), F(queueFamilies, pointer),
              F(queueFamilyCount, count))
REFLET_FIELDS(RefletMemoryCallbacks, F(structSize, size), F(allocate, pointer), F(free, pointer))
REFLET_FIELDS(RefletViewInfo, F(structSize, size), F(width, words), F(height, words), F(framesInFlight, words),
              F(flags, words), F(viewIndex, words))
REFLET_FIELDS(RefletGBuffer, F(structSize, size), F(depth, image), F(depthKind, value), F(normal, image),
              F(normalKind, value), F(normalsInViewSpace, words), F(geometricNormal, image), F(roughness, image),
              F(roughnessChannel, words), F(roughnessKind, value), F(metallic, image), F(metallicChannel, words),
              F(baseColor, image), F(baseColorKind, value), F(f0, image), F(motion, image), F(motionKind, value),
              F(motionScale, reals), F(motionIncludesJitter, words), F(backDepth, image), F(excluded, image),
              F(excludedChannel, words), F(unlit, image), F(unlitChannel, words), F(reactive, image),
              F(reactiveChannel, words))
REFLET_FIELDS(RefletFrameInfo, F(structSize, size), F(commandBuffer, pointer), F(frameIndex, words),
              F(worldToView, reals), F(viewToClip, reals), F(previousWorldToView, reals), F(previousViewToClip, reals),
              F(jitter, reals), F(previousJitter, reals), F(clipYUp, words), F(clipDepthFromMinusOne, words),
              F(elapsed, reals), F(restFrames, words), F(lightChange, reals), F(backgroundIsEnvironment, words),
              F(gbuffer, pointer), F(renderSize, words), F(preExposure, reals))
REFLET_FIELDS(RefletSunShadow, F(structSize, size), F(map, image), F(depthKind, value), F(clipYUp, words),
              F(cascades, words), F(worldToClip, reals), F(cascadeSplits, reals), F(toSun, reals),
              F(angularDiameter, reals), F(contactShadows, words))
REFLET_FIELDS(RefletLampShadow, F(structSize, size), F(position, reals), F(radius, reals), F(range, reals),
              F(direction, reals), F(coneAngle, reals), F(kind, value), F(map, image), F(depth, value),
              F(distanceScale, reals), F(worldToClip, reals), F(clipYUp, words), F(clipDepthFromMinusOne, words),
              F(tiles, words), F(nearPlane, reals), F(farPlane, reals))
REFLET_FIELDS(RefletContactLight, F(structSize, size), F(light, reals), F(isPositional, words))
REFLET_FIELDS(RefletEnvironment, F(structSize, size), F(image, image), F(factor, reals), F(rotation, reals),
              F(worldUp, reals), F(revision, wide))
REFLET_FIELDS(RefletProbe, F(structSize, size), F(position, reals), F(boxCenter, reals), F(boxHalfExtents, reals),
              F(blend, reals), F(parallax, value), F(parallaxCenter, reals), F(parallaxHalfExtents, reals),
              F(radiance, image), F(radianceLevels, words), F(alphaIsCoverage, words), F(distance, image),
              F(irradiance, image), F(irradianceKind, value), F(sphericalHarmonics, pointer), F(revision, wide))
REFLET_FIELDS(RefletPlanarView, F(structSize, size), F(color, image), F(depth, image), F(depthKind, value),
              F(worldToView, reals), F(viewToClip, reals), F(clipYUp, words), F(clipDepthFromMinusOne, words),
              F(plane, reals), F(tolerance, reals))
REFLET_FIELDS(RefletIndirectLight, F(structSize, size), F(light, image), F(environment, pointer),
              F(specularFallback, image), F(irradiance, image), F(irradianceKind, value), F(probeCount, count),
              F(probes, pointer), F(planarViewCount, count), F(planarViewsAfterScreen, words), F(planarViews, pointer),
              F(radianceCache, pointer))
REFLET_FIELDS(RefletLens, F(structSize, size), F(apertureRadius, reals), F(focusDistance, reals), F(blades, words),
              F(bladeRotation, reals))
REFLET_FIELDS(RefletToneMapInfo, F(structSize, size), F(color, pointer), F(autoExposure, words), F(exposure, pointer),
              F(output, pointer), F(format, value), F(transfer, value), F(paperWhite, reals), F(peakLuminance, reals))
REFLET_FIELDS(RefletRayAnswers, F(structSize, size), F(stages, wide), F(access, wide))
REFLET_FIELDS(RefletPrepareInfo, F(structSize, size), F(effects, words), F(gbuffer, pointer),
              F(hasEnvironmentImage, words), F(cascades, words), F(shadowDepthKind, value), F(shadowMapSide, words),
              F(autoExposure, words), F(changesSize, words), F(light, pointer), F(lampMapSide, words),
              F(lampMapTiles, words), F(toneMap, pointer))

#undef F
#undef REFLET_FIELDS
#undef REFLET_FIELD

namespace {

template <class T>
void store(void* to, T value) {
    std::memcpy(to, &value, sizeof value);
}

// Known and unknown ones.
uint32_t format(ApiBytes& bytes) {
    constexpr std::array<VkFormat, 24> formats{VK_FORMAT_UNDEFINED,
                                               VK_FORMAT_R8_UNORM,
                                               VK_FORMAT_R8_SNORM,
                                               VK_FORMAT_R8G8_UNORM,
                                               VK_FORMAT_R8G8B8_UNORM,
                                               VK_FORMAT_R8G8B8A8_UNORM,
                                               VK_FORMAT_R8G8B8A8_SRGB,
                                               VK_FORMAT_R8G8B8A8_UINT,
                                               VK_FORMAT_B8G8R8A8_UNORM,
                                               VK_FORMAT_A2R10G10B10_UNORM_PACK32,
                                               VK_FORMAT_R16_SFLOAT,
                                               VK_FORMAT_R16G16_SFLOAT,
                                               VK_FORMAT_R16G16B16A16_SFLOAT,
                                               VK_FORMAT_R32_SFLOAT,
                                               VK_FORMAT_R32G32_SFLOAT,
                                               VK_FORMAT_R32G32B32A32_SFLOAT,
                                               VK_FORMAT_R64_SFLOAT,
                                               VK_FORMAT_B10G11R11_UFLOAT_PACK32,
                                               VK_FORMAT_D16_UNORM,
                                               VK_FORMAT_D32_SFLOAT_S8_UINT,
                                               VK_FORMAT_S8_UINT,
                                               VK_FORMAT_BC7_UNORM_BLOCK,
                                               VK_FORMAT_G8B8G8R8_422_UNORM,
                                               VK_FORMAT_MAX_ENUM};
    return formats[bytes.below(formats.size())];
}

uint32_t layout(ApiBytes& bytes) {
    constexpr std::array<VkImageLayout, 12> layouts{VK_IMAGE_LAYOUT_UNDEFINED,
                                                    VK_IMAGE_LAYOUT_GENERAL,
                                                    VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL,
                                                    VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL,
                                                    VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL,
                                                    VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
                                                    VK_IMAGE_LAYOUT_PREINITIALIZED,
                                                    VK_IMAGE_LAYOUT_PRESENT_SRC_KHR,
                                                    VK_IMAGE_LAYOUT_READ_ONLY_OPTIMAL,
                                                    VK_IMAGE_LAYOUT_STENCIL_ATTACHMENT_OPTIMAL,
                                                    VK_IMAGE_LAYOUT_SHARED_PRESENT_KHR,
                                                    VK_IMAGE_LAYOUT_MAX_ENUM};
    return layouts[bytes.below(layouts.size())];
}

uint64_t wide(ApiBytes& bytes) {
    return bytes.word() | uint64_t(bytes.word()) << 32U;
}

}  // namespace

void spoilImage(RefletImage& image, ApiBytes& bytes) {
    switch (bytes.below(12)) {
        case 0:
            image.image = VK_NULL_HANDLE;
            break;
        case 1:
            image.view = VK_NULL_HANDLE;
            break;
        case 2:
            store(&image.format, format(bytes));
            break;
        case 3:
            image.width = bytes.word();
            break;
        case 4:
            image.height = bytes.word();
            break;
        case 5:
        case 6:
            store(&image.layout, layout(bytes));
            break;
        case 7:
            image.stages = wide(bytes);
            break;
        case 8:
            image.access = wide(bytes);
            break;
        case 9:
            image.baseLayer = bytes.word();
            image.baseLevel = bytes.word();
            break;
        case 10:
            image.offset[bytes.below(2)] = bytes.word();
            break;
        default:
            image.width += image.offset[0] = bytes.below(4);  // a rectangle in a larger image
            image.height += image.offset[1] = bytes.below(4);
    }
}

void spoilFields(void* of, std::span<const Field> fields, ApiBytes& bytes) {
    const Field& field = fields[bytes.below(static_cast<uint32_t>(fields.size()))];
    auto* const at = static_cast<std::byte*>(of) + field.offset;
    switch (field.kind) {
        case FieldKind::size: {
            constexpr std::array<int, 8> off{-1, 1, -8, 8, -4, 4, -16, 64};
            size_t size = 0;
            std::memcpy(&size, at, sizeof size);
            store(at, bytes.chance(60) ? size_t(bytes.word()) : size + static_cast<size_t>(off[bytes.below(8)]));
            break;
        }
        case FieldKind::reals:
            store(at + 4 * bytes.below(static_cast<uint32_t>(field.bytes / 4)), bytes.real());
            break;
        case FieldKind::words:
            store(at + 4 * bytes.below(static_cast<uint32_t>(field.bytes / 4)), bytes.word());
            break;
        case FieldKind::wide:
            store(at, wide(bytes));
            break;
        case FieldKind::value:
            store(at, field.bytes == 4 && bytes.chance(40) ? format(bytes) : bytes.word() & 0x7FFFFFFFU);
            break;
        case FieldKind::image:
            spoilImage(*reinterpret_cast<RefletImage*>(at), bytes);
            break;
        case FieldKind::pointer:
            std::memset(at, 0, field.bytes);
            break;
        case FieldKind::count: {
            uint32_t count = 0;
            std::memcpy(&count, at, sizeof count);
            store(at, bytes.below(count + 1));
            break;
        }
    }
}

}  // namespace reflet::fuzz
