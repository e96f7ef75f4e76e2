// Draws the window.
#include "view/canvas.h"

#include "capture/show.h"
#include "device/device.h"
#include "device/upload.h"

#include <imgui.h>

#include <algorithm>
#include <array>
#include <cstring>

std::span<const reflet::gpu::Shader> refletViewShaders();

namespace reflet {

namespace {

const gpu::VertexLayout uiLayout{{sizeof(ImDrawVert)},
                                 {{"position", 0, VK_FORMAT_R32G32_SFLOAT, offsetof(ImDrawVert, pos)},
                                  {"uv", 0, VK_FORMAT_R32G32_SFLOAT, offsetof(ImDrawVert, uv)},
                                  {"color", 0, VK_FORMAT_R8G8B8A8_UNORM, offsetof(ImDrawVert, col)}}};

// Grows the buffer to at least so many bytes, with slack, so that small changes of the text do not reallocate it.
void makeRoom(gpu::Device& device, gpu::Buffer& buffer, size_t bytes, VkBufferUsageFlags usage, const char* name) {
    if (buffer.bytes().size() < bytes) {
        buffer = gpu::Buffer(device, bytes + bytes / 2, usage, gpu::MemoryUse::upload, name);
    }
}

}  // namespace

Canvas::Canvas(gpu::Device& device, uvec2 fontSize, std::span<const uint8_t> font, bool swapped)
    : device_(device),
      frame_(device),
      swapped_(swapped),
      font_(gpu::uploadTexture(device, fontSize, font, false, false, "ui font")),
      none_(gpu::uploadTexture(device, uvec2(1), std::array<uint8_t, 4>{0, 0, 0, 255}, false, false, "no picture")),
      vertices_(device, 1 << 16, VK_BUFFER_USAGE_VERTEX_BUFFER_BIT, gpu::MemoryUse::upload, "ui vertices"),
      indices_(device, 1 << 16, VK_BUFFER_USAGE_INDEX_BUFFER_BIT, gpu::MemoryUse::upload, "ui indices") {
    device.shaders().add(refletViewShaders());
}

void Canvas::upload(const ImDrawData& ui) {
    const size_t vertexBytes = size_t(ui.TotalVtxCount) * sizeof(ImDrawVert);
    const size_t indexBytes = size_t(ui.TotalIdxCount) * sizeof(ImDrawIdx);
    makeRoom(device_, vertices_, vertexBytes, VK_BUFFER_USAGE_VERTEX_BUFFER_BIT, "ui vertices");
    makeRoom(device_, indices_, indexBytes, VK_BUFFER_USAGE_INDEX_BUFFER_BIT, "ui indices");
    std::byte* vertex = vertices_.bytes().data();
    std::byte* index = indices_.bytes().data();
    for (int i = 0; i < ui.CmdListsCount; ++i) {
        const ImDrawList& list = *ui.CmdLists[i];
        std::memcpy(vertex, list.VtxBuffer.Data, size_t(list.VtxBuffer.Size) * sizeof(ImDrawVert));
        std::memcpy(index, list.IdxBuffer.Data, size_t(list.IdxBuffer.Size) * sizeof(ImDrawIdx));
        vertex += size_t(list.VtxBuffer.Size) * sizeof(ImDrawVert);
        index += size_t(list.IdxBuffer.Size) * sizeof(ImDrawIdx);
    }
}

void Canvas::recordUi(const gpu::DrawCommands& to, const ImDrawData& ui, uvec2 window) const {
    const VkBuffer vertices = vertices_.handle();
    const VkDeviceSize start = 0;
    device_.vk.vkCmdBindVertexBuffers(to.commands, 0, 1, &vertices, &start);
    device_.vk.vkCmdBindIndexBuffer(to.commands, indices_.handle(), 0,
                                    sizeof(ImDrawIdx) == 2 ? VK_INDEX_TYPE_UINT16 : VK_INDEX_TYPE_UINT32);
    int vertexBase = 0;
    uint32_t indexBase = 0;
    for (int i = 0; i < ui.CmdListsCount; ++i) {
        const ImDrawList& list = *ui.CmdLists[i];
        for (const ImDrawCmd& command : list.CmdBuffer) {
            const vec2 scale(ui.FramebufferScale.x, ui.FramebufferScale.y);
            const vec2 origin(ui.DisplayPos.x, ui.DisplayPos.y);
            const vec2 low =
                glm::clamp((vec2(command.ClipRect.x, command.ClipRect.y) - origin) * scale, vec2(0.0F), vec2(window));
            const vec2 high =
                glm::clamp((vec2(command.ClipRect.z, command.ClipRect.w) - origin) * scale, vec2(0.0F), vec2(window));
            if (high.x <= low.x || high.y <= low.y) {
                continue;
            }
            const VkRect2D scissor{{static_cast<int32_t>(low.x), static_cast<int32_t>(low.y)},
                                   {static_cast<uint32_t>(high.x - low.x), static_cast<uint32_t>(high.y - low.y)}};
            device_.vk.vkCmdSetScissor(to.commands, 0, 1, &scissor);
            device_.vk.vkCmdDrawIndexed(to.commands, command.ElemCount, 1, indexBase + command.IdxOffset,
                                        vertexBase + static_cast<int32_t>(command.VtxOffset), 0);
        }
        vertexBase += list.VtxBuffer.Size;
        indexBase += static_cast<uint32_t>(list.IdxBuffer.Size);
    }
}

gpu::Image Canvas::upload(const Picture& picture, Side& side) {
    if (!picture) {
        side = {};
        return none_.image();
    }
    if (side.of == picture) {
        return side.texture.image();
    }
    const uvec2 size(picture->width, picture->height);
    if (side.texture.info().size != size) {
        side.texture = gpu::Texture(
            device_,
            {VK_FORMAT_R8G8B8A8_UNORM, size, 1, 1, VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT},
            "picture");
    }
    std::vector<uint8_t> texels(size_t(4) * size.x * size.y, 255);
    for (size_t i = 0, from = 0; i < texels.size(); i += 4, from += picture->channels) {
        std::copy_n(picture->data.data() + from, 3, texels.data() + i);
    }
    side.of = picture;
    frame_.upload(side.texture.image(), std::as_bytes(std::span(texels)));
    return side.texture.image();
}

void Canvas::compose(const Picture& left, const Picture& right, const Layout& layout) {
    const gpu::Image a = upload(left, left_);
    const gpu::Image b = upload(right, right_);
    const VkSampler linear = device_.sampler({.mag = VK_FILTER_LINEAR, .min = VK_FILTER_LINEAR});
    Layout shown = layout;
    shown.divider = right ? layout.divider : float(layout.window.x);
    frame_.compute("compose", "compose.comp")
        .read("left", a, linear)
        .read("right", b, linear)
        .write("window", base_.image())
        .params(ComposeParams{shown.window, shown.corner, left ? shown.extent : vec2(0.0F), vec2(a.size), vec2(b.size),
                              shown.divider, shown.linear ? 1U : 0U, swapped_ ? 1U : 0U})
        .dispatch(shown.window);
    baseLayout_ = layout;
}

gpu::Image Canvas::draw(const Picture& left, const Picture& right, const Layout& layout, const ImDrawData& ui) {
    bool composes = left_.of != left || right_.of != right || !(baseLayout_ == layout);
    if (window_.info().size != layout.window) {
        const gpu::ImageInfo info{VK_FORMAT_R8G8B8A8_UNORM, layout.window, 1, 1,
                                  VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT |
                                      VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT |
                                      VK_IMAGE_USAGE_TRANSFER_DST_BIT};
        base_ = gpu::Texture(device_, info, "window without panels");
        window_ = gpu::Texture(device_, info, "window");
        composes = true;
    }
    upload(ui);
    const gpu::Image window = window_.image();
    frame_.begin();
    if (composes) {
        compose(left, right, layout);
    }
    frame_.copy(base_.image(), window);
    const VkSampler linear = device_.sampler({.mag = VK_FILTER_LINEAR, .min = VK_FILTER_LINEAR});
    const vec2 display(std::max(ui.DisplaySize.x, 1.0F), std::max(ui.DisplaySize.y, 1.0F));
    const vec2 scale = 2.0F / display;
    frame_.raster("ui", {"ui.vert", "ui.frag"})
        .read("font", font_.image(), linear)
        .params(UiParams{scale, -1.0F - vec2(ui.DisplayPos.x, ui.DisplayPos.y) * scale, swapped_ ? 1U : 0U})
        .color("window", window, std::nullopt)
        .blend()
        .vertices(uiLayout)
        .draw([&](const gpu::DrawCommands& to) { recordUi(to, ui, layout.window); });
    frame_.submit();
    frame_.wait();
    return window;
}

Bitmap Canvas::picture() {
    frame_.begin();
    const gpu::Readback copy = frame_.readback(window_.image());
    frame_.submit();
    frame_.wait();
    Bitmap bitmap = fetchDisplay(frame_, copy, window_.info().size);
    for (size_t i = 0; swapped_ && i < bitmap.data.size(); i += bitmap.channels) {
        std::swap(bitmap.data[i], bitmap.data[i + 2]);
    }
    return bitmap;
}

}  // namespace reflet
