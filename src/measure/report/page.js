// Makes the comparisons interactive: two overlaid images with a divider. The images are those of the gallery below,
// which works without this script.
"use strict";
(() => {
    // The ground truth has no error maps: its image is shown instead.
    const findPicture = (section, of, kind) => {
        const find = (wanted) => section.querySelector(`img[data-of="${of}"][data-kind="${wanted}"]`);
        return find(kind) || find("picture");
    };

    const setUp = (compare) => {
        const part = (selector) => compare.querySelector(selector);
        const kind = part("select.kind");
        const stage = part(".stage");
        const range = part("input");
        const sides = ["left", "right"].map((side) => ({
            choice: part(`select.${side}`),
            image: part(`img.${side}`),
            tag: part(`.tag.${side}`),
        }));

        const nameOf = ({ choice }) => choice.selectedOptions[0].textContent;

        const showDivider = () => {
            const share = Math.round(range.valueAsNumber);
            stage.style.setProperty("--at", `${range.value}%`);
            range.setAttribute("aria-valuetext",
                               `${share} % ${nameOf(sides[0])}, ${100 - share} % ${nameOf(sides[1])}`);
        };

        const showPictures = () => {
            for (const side of sides) {
                const picture = findPicture(compare.closest("section"), side.choice.value, kind.value);
                side.image.src = picture.getAttribute("src");
                side.image.alt = picture.alt;
                side.tag.textContent = nameOf(side) + (picture.dataset.kind === "picture" ? "" : ", error");
            }
            showDivider();
        };

        const moveTo = (event) => {
            const box = stage.getBoundingClientRect();
            range.value = (100 * (event.clientX - box.left)) / box.width;
            showDivider();
        };

        stage.addEventListener("pointerdown", (event) => {
            if (event.button === 0) {
                stage.setPointerCapture(event.pointerId);
                moveTo(event);
            }
        });
        stage.addEventListener("pointermove", (event) => {
            if (stage.hasPointerCapture(event.pointerId)) {
                moveTo(event);
            }
        });
        range.addEventListener("input", showDivider);
        for (const choice of [kind, sides[0].choice, sides[1].choice]) {
            choice.addEventListener("input", showPictures);
        }
        showPictures();
        compare.hidden = false;
    };

    document.querySelectorAll(".compare").forEach(setUp);
})();
