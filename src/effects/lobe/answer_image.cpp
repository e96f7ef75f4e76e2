// Records a host's image of light as a ray source.
#include "effects/lobe/answer_image.h"

#include "effects/lobe/answer_environment.h"

namespace reflet {

void answerFromImage(gpu::PassList& f, Rays& rays, const LobeImage& image) {
    const gpu::BufferView missed = makeRayList(f, rays);
    const uint32_t scale = rays.from.scale;
    f.compute("answer_image", "answer_image.comp")
        .read("light", image.light)
        .read("waiting", rays.waiting)
        .write("answer", rays.answer)
        .write("source", rays.source)
        .write("missed", missed)
        .params(AnswerImageParams{scale, blockPixelOffset(scale), image.factor, environmentDistance})
        .dispatchIndirect(rays.waiting, 0);
    rays.waiting = missed;
}

}  // namespace reflet
