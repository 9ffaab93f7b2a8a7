// SPDX-License-Identifier: BSD-3-Clause
#include "widgets/panels/result_list.h"

#include "widgets/controls/layout.h"
#include "widgets/controls/text.h"
#include "widgets/controls/theme.h"
#include "widgets/controls/tool_button.h"

#include <QAction>
#include <QHeaderView>
#include <QLabel>
#include <QMenu>
#include <QMouseEvent>
#include <QSignalBlocker>
#include <QToolButton>
#include <QTreeWidget>

#include <algorithm>

namespace episcope {
namespace {

constexpr int kResultRowPadding = 6;
constexpr int kMarkPadding = 32;  // with the icon beside it
constexpr int kWidestMethod = 150;
constexpr int kNarrowestMethod = 80;
constexpr int kMethodPadding = 14;

enum ResultColumn { kMark, kMethod, kMse, kSeconds, kParameters, kResultColumns };

quint64 result_of(const QTreeWidgetItem* item) {
  return item->data(kMark, Qt::UserRole).toULongLong();
}

QString seconds_text(double seconds) {
  if (seconds <= 0) return "–";
  return QString("%1 s").arg(seconds, 0, 'f', seconds < 10 ? 2 : 0);
}

}  // namespace

ResultList::ResultList(QWidget* parent)
    : QWidget(parent),
      tree_(named("results.tree", new QTreeWidget(this))),
      hint_(named("results.hint", new QLabel(this))),
      export_(make_tool_button({"results.export", "export",
                                tr("Save this result as HDF5, PFM, TIFF or PLY"), tr("Export")},
                               this)),
      remove_(make_tool_button({"results.remove", "trash", tr("Remove this result"), tr("Remove")},
                               this)),
      reuse_(make_tool_button({"results.reuse", "reuse",
                               tr("Copy the parameters of this result to the form"), tr("Reuse")},
                              this)) {
  setObjectName("resultList");
  setUpTree();
  lay_out_list(this, hint_, tree_, {export_, reuse_, remove_});

  const auto connect_button = [this](QToolButton* button, void (ResultList::*intent)(quint64)) {
    connect(button, &QToolButton::clicked, this, [this, intent] {
      if (const auto id = target()) emit(this->*intent)(*id);
    });
  };
  connect_button(export_, &ResultList::exportRequested);
  connect_button(remove_, &ResultList::removeRequested);
  connect_button(reuse_, &ResultList::reuseRequested);
  setExpecting(false);
  setResults({});
}

void ResultList::setUpColumns() {
  tree_->setColumnCount(kResultColumns);
  tree_->setHeaderLabels({"", tr("Method"), tr("MSE×100"), tr("Time"), tr("Parameters")});
  tree_->headerItem()->setToolTip(kMse,
                                  tr("Mean squared error ×100 against the ground truth, px²"));
  for (const int column : {kMse, kSeconds}) {
    tree_->headerItem()->setTextAlignment(column, Qt::AlignRight | Qt::AlignVCenter);
  }
  tree_->header()->setMinimumSectionSize(22);
  tree_->header()->setStretchLastSection(false);  // it keeps what it had when others grow
  for (const int column : {kMark, kMse, kSeconds}) {
    tree_->header()->setSectionResizeMode(column, QHeaderView::ResizeToContents);
  }
  // Columns take the size of their contents a little later.
  connect(tree_->header(), &QHeaderView::sectionResized, this, [this](int column) {
    if (column == kMark || column == kMse || column == kSeconds) fitMethods();
  });
}

void ResultList::setUpTree() {
  tree_->setAccessibleName(tr("Results"));
  tree_->viewport()->installEventFilter(this);
  setUpColumns();
  tree_->setRootIsDecorated(false);
  tree_->setAlternatingRowColors(true);
  tree_->setUniformRowHeights(true);
  tree_->setTextElideMode(Qt::ElideRight);
  tree_->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  tree_->setContextMenuPolicy(Qt::CustomContextMenu);
  connect(add_delete_action(tree_), &QAction::triggered, this, [this] {
    if (const auto id = selectedId()) emit removeRequested(*id);
  });
  tree_->setEditTriggers(QAbstractItemView::NoEditTriggers);  // only names can be edited
  connect(tree_, &QTreeWidget::itemDoubleClicked, this, [this](QTreeWidgetItem* item, int column) {
    if (column == kMethod) tree_->editItem(item, kMethod);
  });
  connect(tree_, &QTreeWidget::itemChanged, this, [this](const QTreeWidgetItem* item, int column) {
    if (column == kMethod) emit renameRequested(result_of(item), item->text(kMethod));
  });
  connect(tree_, &QTreeWidget::customContextMenuRequested, this, &ResultList::showMenu);
  connect(tree_, &QTreeWidget::itemSelectionChanged, this, [this] {
    updateButtons();
    if (const auto id = selectedId()) emit selected(*id);
  });
}

void ResultList::setResults(const std::vector<ResultRow>& results) {
  const auto kept = selectedId();
  const QSignalBlocker blocker(tree_);
  // Rows that stay are kept, so that a name can be edited while numbers come in.
  if (!hasRowsOf(results)) tree_->clear();
  const bool is_same = tree_->topLevelItemCount() > 0;
  for (std::size_t i = 0; i < results.size(); ++i) {
    const ResultRow& result = results[i];
    auto* item = is_same ? tree_->topLevelItem(static_cast<int>(i)) : new QTreeWidgetItem(tree_);
    item->setData(kMark, Qt::UserRole, result.id);
    if (!is_same && result.id != kLiveResult) {
      item->setFlags(item->flags() | Qt::ItemIsEditable);  // ends what is typed
    }
    const QString mark = result.is_new ? tr("new") : QString();
    item->setText(kMark, mark);
    // As tall as the row with the icon.
    const int mark_width =
        mark.isEmpty() ? 0 : fontMetrics().horizontalAdvance(mark) + kMarkPadding;
    item->setSizeHint(kMark, {mark_width, fontMetrics().height() + kResultRowPadding});
    item->setText(kMethod, result.method);
    item->setText(kMse, result.mse_100 ? number_text(*result.mse_100, 2) : "–");
    item->setText(kSeconds, seconds_text(result.seconds));
    QStringList aside{result.parameters};
    // Of a note, the first line.
    if (!result.note.isEmpty()) aside.prepend(tr("“%1”").arg(result.note.section('\n', 0, 0)));
    if (!result.warning.isEmpty()) aside.prepend(warned_name(result.warning));
    aside.removeAll({});
    item->setText(kParameters, aside.join(tr(" · ")));
    item->setTextAlignment(kMse, Qt::AlignRight | Qt::AlignVCenter);
    item->setTextAlignment(kSeconds, Qt::AlignRight | Qt::AlignVCenter);
    QStringList tip{result.method, result.note, result.parameters, result.detail};
    tip.removeAll({});
    // Any change of the name's cell, its tip too, would undo what is typed there.
    const bool is_edited = tree_->isPersistentEditorOpen(item, kMethod);
    for (int column = 0; column < kResultColumns; ++column) {
      if (!is_edited || column != kMethod) item->setToolTip(column, tip.join('\n'));
    }
    if (kept == result.id && tree_->currentItem() != item) tree_->setCurrentItem(item);
  }
  fitMethods();
  tree_->setVisible(!results.empty());
  hint_->setVisible(results.empty());
  setShown(shown_, compared_);
  updateButtons();
}

bool ResultList::hasRowsOf(const std::vector<ResultRow>& results) const {
  if (tree_->topLevelItemCount() != static_cast<int>(results.size())) return false;
  for (std::size_t i = 0; i < results.size(); ++i) {
    if (result_of(tree_->topLevelItem(static_cast<int>(i))) != results[i].id) return false;
  }
  return true;
}

void ResultList::setExpecting(bool is_expecting) {
  hint_->setText(is_expecting ? tr("The result appears here.")
                              : tr("No results yet. Run a method above."));
}

void ResultList::setShown(std::optional<quint64> id, std::optional<quint64> compared) {
  const QSignalBlocker blocker(tree_);  // marks are no edits
  const bool is_new = id != shown_;
  shown_ = id;
  compared_ = compared;
  for (int i = 0; i < tree_->topLevelItemCount(); ++i) {
    auto* item = tree_->topLevelItem(i);
    const bool is_shown = shown_ == result_of(item);
    if (compared_) {
      item->setIcon(kMark, side_icon(is_shown                       ? Side::A
                                     : compared_ == result_of(item) ? Side::B
                                                                    : Side::None));
    } else {
      item->setIcon(kMark, is_shown ? themed_icon("eye") : QIcon());
    }
    item->setToolTip(kMark, is_shown ? tr("A: this result is shown")
                                     : tr("Click here to compare with this result (B)"));
    QFont font = tree_->font();
    font.setBold(is_shown);
    item->setFont(kMethod, font);
    if (is_shown && is_new) tree_->scrollToItem(item);
  }
  updateButtons();
}

// Keeps a long name from pushing the numbers out of sight.
void ResultList::fitMethods() {
  QFont bold = tree_->font();
  bold.setBold(true);
  int width = tree_->fontMetrics().horizontalAdvance(tree_->headerItem()->text(kMethod));
  for (int i = 0; i < tree_->topLevelItemCount(); ++i) {
    const QString name = tree_->topLevelItem(i)->text(kMethod);
    width = std::max(width, QFontMetrics(bold).horizontalAdvance(name));
  }
  const QHeaderView& header = *tree_->header();
  const int parameters = header.sectionSizeHint(kParameters);
  int room = tree_->viewport()->width();
  for (const int column : {kMark, kMse, kSeconds}) room -= header.sectionSize(column);
  const int method = std::min(std::min(width, kWidestMethod) + kMethodPadding,
                              std::max(room - parameters, kNarrowestMethod));
  tree_->setColumnWidth(kMethod, method);
  tree_->setColumnWidth(kParameters, std::max(room - method, parameters));
}

// A click on the mark chooses B and leaves the selection (A) alone.
bool ResultList::eventFilter(QObject* watched, QEvent* event) {
  if (watched == tree_->viewport() && event->type() == QEvent::Resize) fitMethods();
  if (watched == tree_->viewport() && event->type() == QEvent::MouseButtonPress) {
    const auto* mouse = static_cast<QMouseEvent*>(event);
    const QPoint position = mouse->position().toPoint();
    const auto* item = tree_->itemAt(position);
    const bool is_on_mark = tree_->header()->logicalIndexAt(position.x()) == kMark;
    const bool can_be_b = item && result_of(item) != shown_ && result_of(item) != kLiveResult;
    if (can_be_b && is_on_mark && mouse->button() == Qt::LeftButton) {
      emit compareRequested(result_of(item));
      return true;
    }
  }
  return QWidget::eventFilter(watched, event);
}

std::optional<quint64> ResultList::selectedId() const {
  const auto items = tree_->selectedItems();
  if (items.isEmpty()) return std::nullopt;
  return result_of(items.front());
}

std::optional<quint64> ResultList::target() const {
  const auto selected = selectedId();
  const auto wanted = selected || tree_->topLevelItemCount() == 0 ? selected : shown_;
  return wanted == kLiveResult ? std::nullopt : wanted;
}

void ResultList::editName(quint64 id) {
  for (int i = 0; i < tree_->topLevelItemCount(); ++i) {
    auto* item = tree_->topLevelItem(i);
    if (result_of(item) == id) tree_->editItem(item, kMethod);
  }
}

void ResultList::updateButtons() {
  for (auto* button : {export_, remove_, reuse_}) button->setEnabled(target().has_value());
}

void ResultList::showMenu(const QPoint& position) {
  const auto* item = tree_->itemAt(position);
  if (!item || result_of(item) == kLiveResult) return;
  const quint64 id = result_of(item);
  auto* menu = named("results.menu", new QMenu(this));
  menu->setAttribute(Qt::WA_DeleteOnClose);
  const auto add = [&](const char* icon, const QString& text, void (ResultList::*intent)(quint64)) {
    menu->addAction(themed_icon(icon), text, this, [this, id, intent] { emit(this->*intent)(id); });
  };
  add("eye", tr("Show"), &ResultList::selected);
  menu->addAction(side_icon(Side::B), tr("Compare with"), this,
                  [this, id] { emit compareRequested(id); });
  add("reuse", tr("Reuse parameters"), &ResultList::reuseRequested);
  add("copy", tr("Copy as command"), &ResultList::copyCommandRequested);
  menu->addSeparator();
  menu->addAction(themed_icon("rename"), tr("Rename"), this, [this, id] { editName(id); });
  add("brush", tr("Note…"), &ResultList::noteRequested);
  add("export", tr("Export…"), &ResultList::exportRequested);
  add("trash", tr("Remove"), &ResultList::removeRequested);
  menu->popup(tree_->viewport()->mapToGlobal(position));
}

}  // namespace episcope

#include "moc_result_list.cpp"
