// A table that is sorted by its columns.

/** A table whose columns sort it, if that says anything. A cell is a text, or a number with its text. */
function table(head, rows, { sorts = rows.length > 1, caption = null } = {}) {
  const body = make("tbody");
  const value = (cell) => (Array.isArray(cell) ? cell[0] : cell);
  const text = (cell) => (Array.isArray(cell) ? cell[1] : cell ?? "–");
  const fill = (list) => body.replaceChildren(...list.map((row) => make("tr", { class: row.mark },
    row.cells.map((cell) => make("td", { class: typeof value(cell) === "number" ? "number" : null }, text(cell) instanceof Node ? text(cell) : String(text(cell)))))));
  const list = rows.map((row) => (Array.isArray(row) ? { cells: row } : row));
  fill(list);
  const heads = head.map((name, k) => {
    const isNumber = typeof value(list[0]?.cells[k]) === "number";
    const cell = make("th", { scope: "col", class: isNumber ? "number" : null }, name);
    if (!sorts) return cell;
    const order = () => {
      const down = cell.getAttribute("aria-sort") === "ascending";
      heads.forEach((other) => other.removeAttribute("aria-sort"));
      cell.setAttribute("aria-sort", down ? "descending" : "ascending");
      const compare = (a, b) => {
        const [x, y] = [value(a.cells[k]), value(b.cells[k])];
        return typeof x === "number" && typeof y === "number" ? x - y : String(x).localeCompare(String(y), "en", { numeric: true });
      };
      fill([...list].sort((a, b) => (down ? -compare(a, b) : compare(a, b))));
    };
    cell.tabIndex = 0;
    cell.addEventListener("click", order);
    cell.addEventListener("keydown", (event) => { if (event.key === "Enter" || event.key === " ") { event.preventDefault(); order(); } });
    return cell;
  });
  return make("div", { class: "scroll" }, make("table", {}, caption && make("caption", {}, caption), make("thead", {}, make("tr", {}, heads)), body));
}
