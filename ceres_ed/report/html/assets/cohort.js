// Sorts the table of a cohort by its heads, and shows one group or verdict of it.
(function () {
  "use strict";
  const table = document.getElementById("members");
  if (!table) return;
  const body = table.tBodies[0];
  const rows = Array.from(body.rows);
  const keyOf = (row, column) => row.cells[column].dataset.key;

  function compare(a, b, column, is_number) {
    const x = keyOf(a, column), y = keyOf(b, column);
    if (!is_number) return x.localeCompare(y, "en", { numeric: true });
    // What is not known stands at the end.
    if (x === "" || y === "") return (x === "") - (y === "");
    return Number(x) - Number(y);
  }

  Array.from(table.tHead.rows[0].cells).forEach((head, column) => {
    const button = head.querySelector("button");
    if (!button) return;
    const is_number = head.classList.contains("n");
    button.addEventListener("click", () => {
      const is_up = head.getAttribute("aria-sort") !== "ascending";
      for (const other of table.tHead.rows[0].cells) other.removeAttribute("aria-sort");
      head.setAttribute("aria-sort", is_up ? "ascending" : "descending");
      const sorted = rows.slice().sort((a, b) => {
        const unknown = is_number && (keyOf(a, column) === "" || keyOf(b, column) === "");
        const order = compare(a, b, column, is_number);
        return is_up || unknown ? order : -order;
      });
      body.append(...sorted);
    });
  });

  const choices = Array.from(document.querySelectorAll("select[data-column]"));
  const shown = document.getElementById("shown");
  function filter() {
    let count = 0;
    for (const row of rows) {
      row.hidden = choices.some((choice) => {
        return choice.value !== "*" && keyOf(row, Number(choice.dataset.column)) !== choice.value;
      });
      if (!row.hidden) ++count;
    }
    shown.textContent = count + " of " + rows.length + " shown";
  }
  for (const choice of choices) choice.addEventListener("change", filter);
  filter();
})();
