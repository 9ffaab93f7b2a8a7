// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/files/builtin_dialog.h"

#include "app/session/scene/builtin_inputs.h"
#include "widgets/estimate/parameter_form.h"
#include "widgets/style/aside_delegate.h"
#include "widgets/style/schema_text.h"
#include "widgets/style/theme.h"

#include <QDialogButtonBox>
#include <QLabel>
#include <QListWidget>
#include <QPushButton>
#include <QVBoxLayout>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

namespace episcope {
namespace {

constexpr int kWidth = 620;
constexpr double kLargestSeed = 999;

std::vector<ParameterDescription> random_parameters() {
  const scenes::RenderOptions defaults;
  ParameterDescription seed{
      .key = "seed",
      .label = QT_TRANSLATE_NOOP("episcope::Schema", "Seed"),
      .help = QT_TRANSLATE_NOOP("episcope::Schema", "Each number is another scene"),
      .unit = "",
      .default_value = static_cast<int>(defaults.seed),
      .min = 0,
      .max = kLargestSeed,
  };
  ParameterDescription kind{
      .key = "kind",
      .label = QT_TRANSLATE_NOOP("episcope::Schema", "Kind"),
      .help = QT_TRANSLATE_NOOP("episcope::Schema", "What the scene is made of; any is a mixture"),
      .unit = "",
      .default_value = scenes::random_kind_name(defaults.kind),
      .choices = scenes::random_kind_names(),
  };
  return {std::move(seed), std::move(kind)};
}

}  // namespace

BuiltinDialog::BuiltinDialog(QWidget* parent)
    : QDialog(parent),
      scenes_(new QListWidget(this)),
      form_(new ParameterForm(this)),
      written_(new QLabel(this)) {
  setObjectName("builtin");
  setWindowTitle(tr("Built-in scenes"));
  scenes_->setObjectName("builtin.scenes");
  scenes_->setItemDelegate(new AsideDelegate(AsideDelegate::Place::Column, scenes_));
  listScenes();
  form_->setParameters(random_parameters());
  written_->setObjectName("builtin.written");
  written_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  written_->setPalette(theme::text_palette(theme::muted_text(palette())));
  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Cancel, this);
  auto* open = buttons->addButton(tr("Open"), QDialogButtonBox::AcceptRole);
  open->setObjectName("builtin.open");
  open->setDefault(true);
  auto* layout = new QVBoxLayout(this);
  layout->addWidget(scenes_, 1);
  layout->addWidget(form_);
  layout->addWidget(written_);
  layout->addWidget(buttons);
  connect(buttons, &QDialogButtonBox::accepted, this, &QDialog::accept);
  connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
  connect(scenes_, &QListWidget::itemDoubleClicked, this, &QDialog::accept);
  connect(scenes_, &QListWidget::currentItemChanged, this, &BuiltinDialog::showChosen);
  connect(form_, &ParameterForm::valuesChanged, this, &BuiltinDialog::showChosen);
  scenes_->setCurrentRow(0);
  resize(kWidth, sizeHint().height());
}

void BuiltinDialog::listScenes() {
  for (const scenes::BuiltinSceneInfo& info : builtin_inputs()) {
    auto* item = new QListWidgetItem(QString::fromStdString(info.id), scenes_);
    item->setData(AsideDelegate::kAsideRole, schema_text(info.summary));
    item->setToolTip(schema_text(info.summary));
  }
}

void BuiltinDialog::showChosen() {
  form_->setEnabled(scene() == scenes::kRandomScene);
  written_->setText(tr("On a command line: %1").arg(input()));
}

QString BuiltinDialog::scene() const {
  const QListWidgetItem* item = scenes_->currentItem();
  return item ? item->text() : QString();
}

QString BuiltinDialog::input() const {
  const QString id = scene();
  if (id != scenes::kRandomScene) return "demo:" + id;
  scenes::RenderOptions options;
  const ParameterSet values = form_->values();
  options.seed = static_cast<unsigned>(std::get<int>(values.at(0).second));
  options.kind = scenes::random_kind_of(std::get<std::string>(values.at(1).second)).value();
  return "demo:" + QString::fromStdString(scenes::builtin_text(id.toStdString(), options));
}

}  // namespace episcope

#include "moc_builtin_dialog.cpp"
