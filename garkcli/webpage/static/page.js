"use strict";
(function () {
  function wordsOf(row) {
    return row.textContent.replace(/\s+/g, " ").toLowerCase();
  }

  function prepare(form) {
    var table = document.getElementById(form.dataset.table);
    var rows = Array.prototype.slice.call(table.tBodies[0].rows);
    var words = rows.map(wordsOf);
    var count = form.querySelector("output");

    function fits(row, key) {
      var field = form.elements.namedItem(key);
      return !field || field.value === "" || field.value === row.dataset[key];
    }

    function update() {
      var text = form.elements.namedItem("text").value.trim().toLowerCase();
      var shown = 0;
      rows.forEach(function (row, k) {
        var isShown = fits(row, "order") && fits(row, "root") &&
          fits(row, "state") && words[k].indexOf(text) >= 0;
        row.hidden = !isShown;
        shown += isShown ? 1 : 0;
      });
      count.textContent = shown + " of " + rows.length + " conditions";
    }

    form.addEventListener("input", update);
    form.addEventListener("submit", function (event) {
      event.preventDefault();
    });
    form.addEventListener("reset", function () {
      setTimeout(update, 0);
    });
    form.hidden = false;
    update();
  }

  /* a box that does not scroll needs no stop of the keyboard */
  function stop(box) {
    var isScrolled = box.scrollWidth > box.clientWidth ||
      box.scrollHeight > box.clientHeight;
    if (isScrolled) {
      box.tabIndex = 0;
    } else {
      box.removeAttribute("tabindex");
    }
  }

  function stops() {
    document.querySelectorAll(".box").forEach(stop);
  }

  document.querySelectorAll("form.filters").forEach(prepare);
  stops();
  window.addEventListener("resize", stops);
})();
