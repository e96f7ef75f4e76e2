// Records contact shadows.
#include "effects/contact/contact.h"

namespace reflet {

gpu::Image contactShadow(gpu::PassList& f, const GBuffer& g, gpu::Image pyramid, gpu::Image byMap,
                         const ContactParams& params) {
    const gpu::Image visibility = f.image("contact_shadow", VK_FORMAT_R8_UNORM, g.depth.size);
    f.compute("contact_shadow", "contact_shadow.comp")
        .read("depth", g.depth)
        .read("geometricNormal", g.geometricNormal)
        .read("pyramid", pyramid)
        .read("byMap", byMap)
        .write("visibility", visibility)
        .params(params)
        .dispatch(visibility.size);
    return visibility;
}

}  // namespace reflet
