// Sorts by the column clicked; summary rows stay below.
document.querySelectorAll('th').forEach(function (head) {
  head.addEventListener('click', function () {
    var table = head.closest('table'), body = table.tBodies[0], column = head.cellIndex;
    var down = head.dataset.down !== 'yes', number = function (row) {
      return parseFloat(row.cells[column].textContent); };
    table.querySelectorAll('th').forEach(function (each) { delete each.dataset.down; });
    head.dataset.down = down ? 'yes' : 'no';
    Array.from(body.rows).sort(function (a, b) {
      var x = number(a), y = number(b), order = isNaN(x) || isNaN(y)
        ? (isNaN(x) ? 1 : 0) - (isNaN(y) ? 1 : 0) ||
          a.cells[column].textContent.localeCompare(b.cells[column].textContent) : x - y;
      return down ? order : -order;
    }).forEach(function (row) { body.appendChild(row); });
  });
});
