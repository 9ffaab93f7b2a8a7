// SPDX-License-Identifier: BSD-3-Clause
#include "widgets/panels/method_panel.h"

#include "widgets/controls/aside_delegate.h"
#include "widgets/controls/layout.h"
#include "widgets/controls/text.h"
#include "widgets/controls/theme.h"
#include "widgets/controls/tool_button.h"

#include <QAbstractItemView>
#include <QCheckBox>
#include <QComboBox>
#include <QDialogButtonBox>
#include <QGridLayout>
#include <QLabel>
#include <QListWidget>
#include <QScrollArea>
#include <QScrollBar>
#include <QSignalBlocker>
#include <QVBoxLayout>

namespace episcope {
namespace {

constexpr int kListWidth = 560;          // names and what the methods do
constexpr const char* kRange = "range";  // of every method; what it says is of the light field

QPushButton* make_button(const char* name, const char* icon, const QString& text,
                         const QString& tip, QWidget* parent) {
  auto* button = named(name, new QPushButton(themed_icon(icon), text, parent));
  button->setToolTip(tip);
  return button;
}

}  // namespace

MethodPanel::MethodPanel(QWidget* parent)
    : QWidget(parent),
      method_(named("method.combo", new QComboBox(this))),
      summary_(named("method.summary", new QLabel(this))),
      reference_(named("method.reference", new QLabel(this))),
      form_(new ParameterForm),
      scroll_(named("method.scroll", new QScrollArea(this))),
      all_views_(named("method.allViews", new QCheckBox(tr("All views"), this))),
      live_status_(named("method.liveStatus", new ElidedLabel(this))),
      run_(make_button("method.run", "run", tr("Run"), tr("Estimate with these parameters"), this)),
      live_(make_button("method.live", "live", tr("Live"), {}, this)),
      cancel_(make_button("method.cancel", "stop", tr("Cancel"), tr("Cancel all runs"), this)),
      reset_(make_button("method.reset", "reset", tr("Reset"),
                         tr("Reset all parameters to their defaults"), this)),
      copy_(make_button("method.copyCommand", "copy", tr("Copy as command"),
                        tr("Copy the equivalent episcope-cli command"), this)) {
  setObjectName("methodPanel");
  method_->setToolTip(tr("Estimation method"));
  method_->setItemDelegate(new AsideDelegate(AsideDelegate::Place::Column, method_));
  method_->view()->setMinimumWidth(kListWidth);
  summary_->setWordWrap(true);
  reference_->setWordWrap(true);
  reference_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  all_views_->setToolTip(tr("Estimate all views instead of the center view only"));
  live_->setCheckable(true);
  live_status_->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Fixed);
  run_->setDefault(true);

  set_up_scrolling(scroll_);
  auto* sheet = new QWidget(scroll_);
  make_column(sheet, {form_, kRoom});
  scroll_->setWidget(sheet);
  // The tab shines through.
  scroll_->viewport()->setAutoFillBackground(false);
  sheet->setAutoFillBackground(false);

  auto* buttons = new QGridLayout;
  buttons->setSpacing(theme::kSpacing);
  buttons->addLayout(make_row({{run_, 1}, live_}, {.spacing = theme::kSpacing}), 0, 0);
  buttons->addWidget(cancel_, 0, 1);
  buttons->addWidget(reset_, 1, 0);
  buttons->addWidget(copy_, 1, 1);
  auto* views = make_row({all_views_, {live_status_, 1}}, {.spacing = theme::kSpacing});
  make_column(this, {method_, summary_, reference_, {scroll_, 1}, views, buttons},
              {.spacing = theme::kSpacing});
  connectControls();
  setRunning(false);
  setMethods({});
  theme::mute(reference_);
  theme::mute(live_status_);
}

void MethodPanel::connectControls() {
  connect(method_, &QComboBox::currentIndexChanged, this, [this](int index) {
    showMethod(index);
    emit methodChanged(QString::fromStdString(request().method));
    emit requestChanged();
  });
  connect(run_, &QPushButton::clicked, this, [this] { emit runRequested(request()); });
  connect(cancel_, &QPushButton::clicked, this, &MethodPanel::cancelRequested);
  connect(reset_, &QPushButton::clicked, form_, &ParameterForm::resetToDefaults);
  connect(copy_, &QPushButton::clicked, this, [this] { emit copyCommandRequested(request()); });
  connect(form_, &ParameterForm::valuesChanged, this, [this] {
    updateReset();
    emit requestChanged();
  });
  connect(form_, &ParameterForm::heightChanged, this, &MethodPanel::updateGeometry);
  connect(live_, &QPushButton::clicked, this, &MethodPanel::liveToggled);
}

void MethodPanel::setMethods(std::vector<MethodDescription> methods) {
  const QSignalBlocker blocker(method_);
  methods_ = std::move(methods);
  kept_values_.clear();
  shown_ = -1;
  method_->clear();
  for (const auto& method : methods_) {
    method_->addItem(QString::fromStdString(method.name), QString::fromStdString(method.id));
    for (const int role : {static_cast<int>(Qt::ToolTipRole), AsideDelegate::kAsideRole}) {
      method_->setItemData(method_->count() - 1, schema_text(method.summary), role);
    }
  }
  showMethod(method_->currentIndex());
}

void MethodPanel::showMethod(int index) {
  const ParameterSet former = form_->values();
  if (shown_ >= 0) kept_values_[methods_[shown_].id] = former;
  shown_ = index;
  const bool has_method = index >= 0;
  method_->setEnabled(has_method);
  const MethodDescription method = has_method ? methods_[index] : MethodDescription{};
  summary_->setText(schema_text(method.summary));
  reference_->setText(schema_text(method.reference));
  reference_->setVisible(!method.reference.empty());
  all_views_->setEnabled(method.all_views);
  all_views_->setChecked(method.all_views);
  form_->setParameters(method.parameters, method.main_parameters);
  if (const auto kept = kept_values_.find(method.id); kept != kept_values_.end()) {
    form_->setValues(kept->second);
  }
  if (const ParameterValue* range = find_value(former, kRange))
    form_->setValues({{kRange, *range}});
  // The form has no horizontal scroll bar: it never gets less than it needs.
  scroll_->widget()->layout()->activate();
  scroll_->setMinimumWidth(scroll_->widget()->minimumSizeHint().width() +
                           scroll_->verticalScrollBar()->sizeHint().width());
  updateGeometry();
  updateReset();
  setRunBlocked(blocked_);
}

void MethodPanel::setCurrentMethod(const std::string& id) {
  const int index = method_->findData(QString::fromStdString(id));
  if (index >= 0) method_->setCurrentIndex(index);
}

void MethodPanel::setRequest(const RunRequest& request) {
  if (method_->findData(QString::fromStdString(request.method)) < 0) return;
  setCurrentMethod(request.method);
  form_->resetToDefaults();
  form_->setValues(request.values);
  if (all_views_->isEnabled()) all_views_->setChecked(request.all_views);
  updateReset();
  emit requestChanged();
}

void MethodPanel::setRunBlocked(const QString& reason) {
  blocked_ = reason;
  run_->setEnabled(reason.isEmpty() && shown_ >= 0);
  copy_->setEnabled(run_->isEnabled());
  live_->setEnabled(run_->isEnabled() || live_->isChecked());
  run_->setToolTip(reason.isEmpty() ? tr("Estimate with these parameters") : reason);
}

void MethodPanel::followLiveTip(const QAction* live) {
  follow_tip(live_, live);
}

void MethodPanel::followTips(const QAction* cancel, const QAction* copy) {
  follow_tip(cancel_, cancel);
  follow_tip(copy_, copy);
}

QSize MethodPanel::sizeHint() const {
  const QWidget* sheet = scroll_->widget();  // in which names of changed values may wrap
  const int sheet_height = sheet->hasHeightForWidth()
                               ? sheet->heightForWidth(scroll_->viewport()->width())
                               : sheet->sizeHint().height();
  int height = -layout()->spacing();
  for (int i = 0; i < layout()->count(); ++i) {
    const QLayoutItem* item = layout()->itemAt(i);
    if (item->isEmpty()) continue;
    height += layout()->spacing();
    height += item->widget() == scroll_   ? sheet_height
              : item->hasHeightForWidth() ? item->heightForWidth(width())
                                          : item->sizeHint().height();
  }
  return {QWidget::sizeHint().width(), height};
}

RunRequest MethodPanel::request() const {
  if (shown_ < 0) return {};
  return {methods_[shown_].id, form_->values(), all_views_->isEnabled() && all_views_->isChecked()};
}

namespace {

constexpr QSize kSize(520, 420);

QStringList checked(const QListWidget& list) {
  QStringList ids;
  for (int i = 0; i < list.count(); ++i) {
    const QListWidgetItem* item = list.item(i);
    if (item->checkState() == Qt::Checked) ids << item->data(Qt::UserRole).toString();
  }
  return ids;
}

}  // namespace

BatchDialog::BatchDialog(const std::vector<Row>& methods, const std::vector<Row>& scenes,
                         QWidget* parent)
    : QDialog(parent) {
  setObjectName("batch");
  setWindowTitle(tr("Run on several light fields"));
  auto* layout = new QGridLayout(this);
  methods_ = addList("batch.methods", tr("Methods"), methods);
  scenes_ = addList("batch.scenes", tr("Light fields"), scenes);
  layout->addWidget(new QLabel(tr("Methods"), this), 0, 0);
  layout->addWidget(new QLabel(tr("Light fields"), this), 0, 1);
  layout->addWidget(methods_, 1, 0);
  layout->addWidget(scenes_, 1, 1);
  auto* answers = make_answers(this, "batch.run", {});
  run_ = answers->findChild<QPushButton*>("batch.run");
  layout->addWidget(answers, 2, 0, 1, 2);
  resize(kSize);
  showCount();
}

QListWidget* BatchDialog::addList(const QString& name, const QString& title,
                                  const std::vector<Row>& rows) {
  auto* list = named(name, new QListWidget(this));
  list->setAccessibleName(title);
  list->setTextElideMode(Qt::ElideMiddle);
  list->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  for (const Row& row : rows) {
    auto* item = new QListWidgetItem(row.name, list);
    item->setData(Qt::UserRole, row.id);
    item->setToolTip(row.name);
    item->setFlags(item->flags() | Qt::ItemIsUserCheckable);
    item->setCheckState(row.is_checked ? Qt::Checked : Qt::Unchecked);
  }
  connect(list, &QListWidget::itemChanged, this, &BatchDialog::showCount);
  return list;
}

void BatchDialog::showCount() {
  const auto count = methods().size() * scenes().size();
  run_->setText(tr("Run (%1)").arg(count));
  run_->setEnabled(count > 0);
}

QStringList BatchDialog::methods() const {
  return checked(*methods_);
}

QStringList BatchDialog::scenes() const {
  return checked(*scenes_);
}

}  // namespace episcope

#include "moc_method_panel.cpp"
