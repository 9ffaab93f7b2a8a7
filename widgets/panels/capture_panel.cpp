// SPDX-License-Identifier: BSD-3-Clause
#include "widgets/panels/capture_panel.h"

#include "widgets/cloud/point_cloud_view.h"
#include "widgets/controls/layout.h"
#include "widgets/controls/text.h"
#include "widgets/controls/theme.h"
#include "widgets/controls/tool_button.h"

#include <QComboBox>
#include <QEvent>
#include <QGridLayout>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QLabel>
#include <QLineEdit>
#include <QMenu>
#include <QPushButton>
#include <QSignalBlocker>
#include <QStackedLayout>
#include <QTableWidget>

#include <algorithm>
#include <initializer_list>
#include <memory>

namespace episcope {
namespace {

enum PairColumn { kPairName, kPairLock, kPairPixel, kPairPoint, kPairOff };

QPushButton* make_button(QWidget* parent, const char* name, const QString& text,
                         const QString& tip) {
  auto* button = named(name, new QPushButton(text, parent));
  button->setToolTip(tip);
  return button;
}

QLabel* make_text(QWidget* parent, const char* name) {
  auto* label = named(name, new QLabel(parent));
  label->setWordWrap(true);
  return label;
}

QTableWidgetItem* make_cell(const QString& text, bool is_editable) {
  auto* item = new QTableWidgetItem(text);
  if (!is_editable) item->setFlags(item->flags() & ~Qt::ItemIsEditable);
  item->setToolTip(text);
  return item;
}

QString point_text(const std::array<double, 3>& point) {
  const auto& [x, y, z] = point;
  return with_minus(QString("%1, %2, %3").arg(x, 0, 'g', 5).arg(y, 0, 'g', 5).arg(z, 0, 'g', 5));
}

}  // namespace

CapturePanel::CapturePanel(QWidget* parent)
    : QWidget(parent),
      steps_(new PhotographSteps(this)),
      objects_(new CaptureObjects(this)),
      hint_(make_text(this, "capture.hint")),
      next_(make_text(this, "capture.next")),
      pose_(make_text(this, "capture.pose")),
      snap_(named("capture.snap", new QCheckBox(tr("Snap"), this))),
      add_(make_button(this, "capture.add", tr("Add pair"),
                       tr("The cross-hair and the marked point of the mesh are the same point"))),
      undo_(
          make_tool_button({"capture.undo", "undo", tr("Undo the last change of this tab")}, this)),
      redo_(make_tool_button({"capture.redo", "redo", tr("Redo the last undone change")}, this)),
      table_(named("capture.pairs", new QTableWidget(this))),
      stack_(new QStackedLayout) {
  setObjectName("capturePanel");
  snap_->setToolTip(
      tr("Takes the corner or the center of the blob beside the cross-hair, to a "
         "fraction of a pixel"));
  make_column(this, {steps_, {makeView(), 3}, {makePairs(), 2}, makeResults()},
              {.spacing = theme::kSpacing});
  setMesh(std::make_shared<const CloudParts>());
  setRows({});
  setNext({}, std::nullopt, false);
  setPose({}, false);
  setUndoable(false);
  setRedoable(false);
}

QWidget* CapturePanel::makeView() {
  auto* part = new QWidget(this);
  hint_->setText(
      tr("Open a mesh of an object in the light field. Then set the cross-hair in the center view, "
         "click the same point of the mesh here, and add the pair. Four pairs give its "
         "pose.\n\nWithout a gantry at hand, “Lens” makes a demo to try it with."));
  hint_->setAlignment(Qt::AlignCenter);
  QWidget* made = make_point_cloud_view(part);
  view_ = qobject_cast<PointCloudView*>(made);
  if (view_) connect(view_, &PointCloudView::pointPicked, this, &CapturePanel::vertexPicked);
  stack_->addWidget(hint_);
  stack_->addWidget(made);
  make_column(part, {objects_, {stack_, 1}});
  return part;
}

QWidget* CapturePanel::makePairs() {
  auto* part = new QWidget(this);
  table_->setAccessibleName(tr("Picked pairs"));
  table_->setColumnCount(5);
  table_->setHorizontalHeaderLabels({tr("Pair"), tr("Lock"), tr("View"), tr("Mesh"), tr("Off by")});
  table_->horizontalHeader()->setSectionResizeMode(QHeaderView::ResizeToContents);
  table_->horizontalHeader()->setSectionResizeMode(kPairPoint, QHeaderView::Stretch);
  table_->verticalHeader()->hide();
  table_->verticalHeader()->setDefaultSectionSize(fontMetrics().height() + 2 * theme::kSpacing);
  table_->setSelectionBehavior(QAbstractItemView::SelectRows);
  table_->setMouseTracking(true);
  table_->viewport()->installEventFilter(this);
  connect(table_, &QTableWidget::cellChanged, this, &CapturePanel::change);
  connect(table_, &QTableWidget::cellEntered, this, [this](int row) { hover(row); });
  connect(table_, &QTableWidget::itemSelectionChanged, this, [this] {
    enableRowButtons();
    emit emphasisChanged();
  });
  connect(table_, &QTableWidget::cellDoubleClicked, this, [this](int row, int column) {
    if (column != kPairName && column != kPairLock) emit rowChosen(row);
  });
  remove_ = make_button(part, "capture.remove", tr("Remove"), tr("Removes the chosen pairs"));
  auto* import = make_button(part, "capture.import", tr("Import…"), tr("Adds pairs from CSV"));
  export_ = make_button(part, "capture.export", tr("Export…"), tr("Writes all pairs as CSV"));
  auto* buttons = new QHBoxLayout;
  for (QWidget* each : std::initializer_list<QWidget*>{remove_, undo_, redo_, import, export_}) {
    buttons->addWidget(each);
  }
  auto* next = make_row({{next_, 1}, snap_, add_});
  make_column(part, {next, {table_, 1}, buttons});
  connect(snap_, &QCheckBox::toggled, this, &CapturePanel::snapChanged);
  connect(add_, &QPushButton::clicked, this, &CapturePanel::addRequested);
  connect(remove_, &QPushButton::clicked, this, &CapturePanel::removeRequested);
  connect(undo_, &QToolButton::clicked, this, &CapturePanel::undoRequested);
  connect(redo_, &QToolButton::clicked, this, &CapturePanel::redoRequested);
  connect(import, &QPushButton::clicked, this, &CapturePanel::importRequested);
  connect(export_, &QPushButton::clicked, this, &CapturePanel::exportRequested);
  enableRowButtons();
  return part;
}

QWidget* CapturePanel::makeResults() {
  auto* part = new QWidget(this);
  auto* show = make_button(part, "capture.show", tr("Show over view"),
                           tr("Adds the disparity of the mesh to the results, to be drawn over the "
                              "view, wiped and compared"));
  auto* save = make_button(part, "capture.savePose", tr("Save pose…"),
                           tr("Writes pose, pairs and errors as JSON"));
  auto* truth = make_button(part, "capture.writeTruth", tr("Write ground truth…"),
                            tr("Writes the light field with the depth of the mesh in all views"));
  of_pose_ = {show, save, truth};
  auto* buttons = new QHBoxLayout;
  for (QPushButton* each : of_pose_) buttons->addWidget(each);
  make_column(part, {pose_, buttons});
  connect(show, &QPushButton::clicked, this, &CapturePanel::showRequested);
  connect(save, &QPushButton::clicked, this, &CapturePanel::savePoseRequested);
  connect(truth, &QPushButton::clicked, this, &CapturePanel::writeTruthRequested);
  return part;
}

void CapturePanel::setMesh(const CloudPartsPtr& mesh) {
  stack_->setCurrentIndex(mesh->empty() ? 0 : 1);
  if (!view_ || mesh->empty()) return;
  view_->setParts(mesh);
  view_->showPreset(CloudPreset::Front);
}

void CapturePanel::setPicked(const std::optional<std::array<double, 3>>& point) {
  if (!view_) return;
  view_->setMarkedPlaces(point ? std::vector{*point} : std::vector<std::array<double, 3>>());
}

void CapturePanel::setMarks(const std::vector<CloudMark>& marks) {
  if (view_) view_->setNamedMarks(marks);
}

void CapturePanel::hover(std::optional<int> row) {
  if (row == hovered_) return;
  hovered_ = row;
  const QSignalBlocker blocker(table_);
  for (int i = 0; i < table_->rowCount(); ++i) {
    QFont font = table_->font();
    font.setBold(i == hovered_);
    for (int column = 0; column < table_->columnCount(); ++column) {
      table_->item(i, column)->setFont(font);
    }
  }
  emit emphasisChanged();
}

bool CapturePanel::isEmphasised(int row) const {
  return row == hovered_ || table_->selectionModel()->isRowSelected(row, {});
}

bool CapturePanel::eventFilter(QObject* watched, QEvent* event) {
  if (event->type() == QEvent::Leave) hover(std::nullopt);
  return QWidget::eventFilter(watched, event);
}

void CapturePanel::setRows(const std::vector<CaptureRow>& rows) {
  const QSignalBlocker blocker(table_);
  const bool has_new = static_cast<int>(rows.size()) > table_->rowCount();
  table_->setRowCount(static_cast<int>(rows.size()));
  for (int i = 0; i < table_->rowCount(); ++i) {
    const CaptureRow& row = rows[i];
    table_->setItem(i, kPairName, make_cell(row.name, !row.is_locked));
    auto* lock = make_cell({}, false);
    lock->setFlags(lock->flags() | Qt::ItemIsUserCheckable);
    lock->setCheckState(row.is_locked ? Qt::Checked : Qt::Unchecked);
    lock->setToolTip(
        tr("A locked pair is trusted: it is neither removed nor treated as a wrong pick"));
    table_->setItem(i, kPairLock, lock);
    table_->setItem(
        i, kPairPixel,
        make_cell(
            with_minus(
                QString("%1, %2").arg(row.pixel.x(), 0, 'f', 1).arg(row.pixel.y(), 0, 'f', 1)),
            false));
    table_->setItem(i, kPairPoint, make_cell(point_text(row.point), false));
    const QString off = row.off_px ? tr("%1 px").arg(*row.off_px, 0, 'f', 2) : QString();
    table_->setItem(i, kPairOff,
                    make_cell(row.is_outlier ? tr("%1, wrong?").arg(off) : off, false));
  }
  if (has_new) table_->scrollToBottom();
  enableRowButtons();
}

void CapturePanel::enableRowButtons() {
  remove_->setEnabled(!selectedRows().empty());
  export_->setEnabled(table_->rowCount() > 0);
}

void CapturePanel::setNext(const QString& pixel, const std::optional<std::array<double, 3>>& point,
                           bool is_complete) {
  next_->setText(tr("View %1 · mesh %2")
                     .arg(pixel.isEmpty() ? tr("–") : pixel,
                          point ? point_text(*point) : tr("(click a point)")));
  add_->setEnabled(is_complete);
}

void CapturePanel::setPose(const QString& text, bool is_known) {
  pose_->setText(text);
  for (QPushButton* each : of_pose_) each->setEnabled(is_known);
}

std::vector<int> CapturePanel::selectedRows() const {
  std::vector<int> rows;
  for (const QModelIndex& index : table_->selectionModel()->selectedRows()) {
    rows.push_back(index.row());
  }
  std::ranges::sort(rows);
  return rows;
}

void CapturePanel::change(int row, int column) {
  const QTableWidgetItem& item = *table_->item(row, column);
  if (column == kPairName) emit renamed(row, item.text());
  if (column == kPairLock) emit lockChanged(row, item.checkState() == Qt::Checked);
}

CaptureObjects::CaptureObjects(QWidget* parent)
    : QWidget(parent),
      names_(named("capture.objects", new QComboBox(this))),
      remove_(make_button(this, "capture.removeObject", tr("Remove"),
                          tr("Removes this object with its pairs"))),
      mesh_(named("capture.mesh", new ElidedLabel(this, Qt::ElideMiddle))) {
  names_->setAccessibleName(tr("Objects"));
  names_->setToolTip(
      tr("The object whose pairs are picked; type to rename it. Each has its own mesh and pose."));
  names_->setEditable(true);
  names_->setInsertPolicy(QComboBox::NoInsert);
  names_->setCompleter(nullptr);
  names_->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
  names_->setMinimumContentsLength(6);
  auto* add = make_button(this, "capture.addObject", tr("Add…"),
                          tr("Adds one more object, with a mesh of its own"));
  auto* open = make_button(this, "capture.open", tr("Open mesh…"),
                           tr("A scan of an object in the light field: PLY, OBJ or STL"));
  auto* layout = make_grid(this, -1, theme::kSpacing / 2);
  layout->setColumnStretch(0, 1);
  layout->addWidget(names_, 0, 0);
  layout->addWidget(add, 0, 1);
  layout->addWidget(remove_, 0, 2);
  layout->addWidget(mesh_, 1, 0);
  layout->addWidget(open, 1, 1, 1, 2);
  connect(names_, &QComboBox::activated, this, &CaptureObjects::chosen);
  connect(names_->lineEdit(), &QLineEdit::editingFinished, this, [this] {
    const int now = names_->currentIndex();
    if (now >= 0 && names_->currentText() != names_->itemText(now)) {
      emit renamed(names_->currentText().trimmed());
    }
  });
  connect(add, &QPushButton::clicked, this, &CaptureObjects::addRequested);
  connect(remove_, &QPushButton::clicked, this, &CaptureObjects::removeRequested);
  connect(open, &QPushButton::clicked, this, &CaptureObjects::openMeshRequested);
  setObjects({}, 0);
  setMesh({});
}

void CaptureObjects::setObjects(const QStringList& names, int current) {
  const bool is_there = current >= 0 && current < names.size();
  names_->clear();
  names_->addItems(names);
  names_->setCurrentIndex(is_there ? current : -1);
  names_->setEditText(is_there ? names[current] : QString());
  names_->setEnabled(is_there);
  remove_->setEnabled(is_there);
}

PhotographSteps::PhotographSteps(QWidget* parent)
    : QWidget(parent),
      camera_(named("capture.camera", new ElidedLabel(this))),
      alignment_(named("capture.alignment", new ElidedLabel(this))),
      lens_(named("capture.lens", new QPushButton(tr("Lens"), this))),
      rectify_(named("capture.rectify", new QPushButton(tr("Rectify…"), this))) {
  rectify_->setToolTip(
      tr("Rectifies the open photographs into a light field with aligned rows and columns. Pairs "
         "picked in them are carried over."));
  auto* menu = new QMenu(lens_);
  menu->addAction(tr("Calibrate from photographs…"), this, &PhotographSteps::calibrateRequested);
  menu->addAction(tr("Open a camera…"), this, &PhotographSteps::openCameraRequested);
  save_ = menu->addAction(tr("Save the camera…"), this, &PhotographSteps::saveCameraRequested);
  menu->addSeparator();
  menu->addAction(tr("Make a demo to try it with…"), this, &PhotographSteps::demoRequested);
  lens_->setMenu(menu);
  connect(rectify_, &QPushButton::clicked, this, &PhotographSteps::rectifyRequested);

  auto* layout = make_grid(this, -1, theme::kSpacing / 2);
  layout->setColumnStretch(0, 1);
  layout->addWidget(camera_, 0, 0);
  layout->addWidget(lens_, 0, 1);
  layout->addWidget(alignment_, 1, 0);
  layout->addWidget(rectify_, 1, 1);
  setCamera({}, {}, false);
  setAlignment({}, false);
}

void PhotographSteps::setCamera(const QString& text, const QString& details, bool is_known) {
  camera_->setFullText(text.isEmpty() ? tr("No lens calibrated") : text);
  const QString help = tr("Calibrates the camera from photographs of a flat pattern");
  lens_->setToolTip(details.isEmpty() ? help : details);
  save_->setEnabled(is_known);
}

void PhotographSteps::setAlignment(const QString& text, bool can_rectify) {
  alignment_->setFullText(text);
  rectify_->setEnabled(can_rectify);
}

}  // namespace episcope

#include "moc_capture_panel.cpp"
