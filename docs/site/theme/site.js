// Search in an index that is a script, so that it works from a folder; sliders between a picture and its reference;
// tables that scroll. Pages can be read without any of it.
"use strict";
(() => {
    const base = document.currentScript.dataset.base;

    const make = (tag, properties, ...children) => {
        const element = Object.assign(document.createElement(tag), properties);
        element.append(...children);
        return element;
    };

    // Every word must be there; titles count more than text, and beginnings of words more than their middles.
    const score = ([, title, text], words) => {
        let sum = 0;
        for (const word of words) {
            const inTitle = title.toLowerCase().includes(word);
            const inText = text.toLowerCase().includes(word);
            if (!inTitle && !inText) {
                return 0;
            }
            sum += (inTitle ? 20 : 0) + Math.min(5, text.toLowerCase().split(word).length - 1);
        }
        return sum;
    };

    const setUpSearch = () => {
        const field = document.querySelector(".search input");
        const results = document.querySelector(".results");
        let loading = null;
        const load = () => loading ??= new Promise((resolve) => {
            document.head.append(make("script", { src: `${base}/search_index.js`, onload: resolve }));
        });
        const show = async () => {
            await load();
            const words = field.value.toLowerCase().split(/\s+/).filter((w) => w.length > 1);
            const found = words.length === 0 ? [] : window.searchIndex.map((entry) => [score(entry, words), entry])
                .filter(([s]) => s > 0).sort((a, b) => b[0] - a[0]).slice(0, 12);
            results.replaceChildren(...found.map(([, [location, title, text]]) => {
                const start = Math.max(0, text.toLowerCase().indexOf(words[0]) - 40);
                return make("a", { href: `${base}/${location}` }, title, make("small", {}, text.slice(start, start + 160)));
            }));
            if (words.length > 0 && found.length === 0) {
                results.append("nothing found");
            }
            results.hidden = words.length === 0;
        };
        field.addEventListener("focus", load, { once: true });
        field.addEventListener("input", show);
    };

    // Pictures of the page's tables with their captions: the text below a picture, or the head of its column.
    const captioned = () => {
        const all = [];
        for (const table of document.querySelectorAll("main table")) {
            const rows = [...table.rows].map((row) => [...row.cells]);
            rows.forEach((cells, y) => cells.forEach((cell, x) => {
                const image = cell.querySelector("img");
                if (!image) {
                    return;
                }
                const below = rows[y + 1]?.[x];
                const caption = below && !below.querySelector("img") ? below : rows[0][x];
                const text = (caption.textContent || image.alt).trim();
                all.push({ image, table, text: text || image.alt });
            }));
        }
        return all;
    };

    // Below the first table of pictures: any of them over the reference, with a divider between them.
    const addWipe = () => {
        const pictures = captioned();
        const reference = pictures.findIndex(({ text }) => /^(the )?(path-traced )?(reference|ground truth)/i.test(text));
        if (reference < 0 || pictures.length < 2) {
            return;
        }
        const { image: truth, text: name } = pictures[reference];
        const left = make("img", {});
        const right = make("img", { className: "over", src: truth.src, alt: truth.alt });
        const stage = make("div", { className: "stage" }, left, right);
        const range = make("input", { type: "range", min: 0, max: 100, value: 50, ariaLabel: "divider" });
        const choice = make("select", { ariaLabel: "left picture" });
        pictures.forEach(({ text }, i) => i !== reference && choice.append(make("option", { value: i }, text)));
        const move = () => stage.style.setProperty("--at", `${range.value}%`);
        const choose = () => {
            const { image } = pictures[choice.value];
            Object.assign(left, { src: image.src, alt: image.alt });
        };
        const drag = (event) => {
            const box = stage.getBoundingClientRect();
            range.value = (100 * (event.clientX - box.left)) / box.width;
            move();
        };
        range.addEventListener("input", move);
        choice.addEventListener("input", choose);
        stage.addEventListener("pointermove", (event) => event.buttons === 1 && drag(event));
        stage.addEventListener("pointerdown", drag);
        choose();
        move();
        pictures[0].table.after(make("div", { className: "wipe" }, stage,
                                     make("div", { className: "row" }, choice, range, make("span", {}, name))));
    };

    setUpSearch();
    addWipe();
    for (const table of document.querySelectorAll("main table")) {
        const wide = make("div", { className: "wide" });
        table.before(wide);
        wide.append(table);
    }
    if (matchMedia("(max-width: 50rem)").matches) {
        document.querySelector(".pages").open = false;
    }
})();
