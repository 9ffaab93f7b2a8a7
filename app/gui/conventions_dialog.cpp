// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/conventions_dialog.h"

#include "widgets/controls/elided_label.h"

#include <QCheckBox>
#include <QComboBox>
#include <QDialogButtonBox>
#include <QFormLayout>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QVBoxLayout>

namespace episcope {
namespace {

using Flip = io::OpenOptions::Flip;
using Units = io::OpenOptions::Units;

constexpr int kWidth = 460;

}  // namespace

ConventionsDialog::ConventionsDialog(const QString& path, const io::OpenOptions& current,
                                     Scope scope, QWidget* parent)
    : QDialog(parent),
      order_(new QComboBox(this)),
      units_(new QComboBox(this)),
      pattern_(new QLineEdit(this)),
      snake_(new QCheckBox(tr("every second row runs from right to left"), this)) {
  setObjectName("conventions");
  setWindowTitle(tr("Conventions"));
  auto* file = new ElidedLabel(this, Qt::ElideMiddle);
  file->setFullText(path);
  auto* note = new QLabel(tr("The file is read again, and your choice is remembered for it. "
                             "Results of this light field are removed from the list."),
                          this);
  note->setWordWrap(true);
  auto* form = new QFormLayout;
  addOrder(*form);
  addUnits(*form);
  addNames(*form);
  form->setRowVisible(units_, scope.has_units);
  form->setRowVisible(pattern_, scope.has_names);
  form->setRowVisible(snake_, scope.has_names);
  auto* buttons =
      new QDialogButtonBox(QDialogButtonBox::Cancel | QDialogButtonBox::RestoreDefaults, this);
  auto* apply = buttons->addButton(tr("Read again"), QDialogButtonBox::AcceptRole);
  apply->setObjectName("conventions.apply");
  apply->setDefault(true);
  QPushButton* reset = buttons->button(QDialogButtonBox::RestoreDefaults);
  reset->setText(tr("All automatic"));
  reset->setObjectName("conventions.reset");
  auto* layout = new QVBoxLayout(this);
  layout->addWidget(file);
  layout->addLayout(form);
  layout->addWidget(note);
  layout->addStretch(1);
  layout->addWidget(buttons);
  connect(buttons, &QDialogButtonBox::accepted, this, &QDialog::accept);
  connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
  connect(reset, &QPushButton::clicked, this, [this] { display({}); });
  display(current);
  resize(kWidth, sizeHint().height());
}

void ConventionsDialog::addOrder(QFormLayout& form) {
  order_->setObjectName("conventions.order");
  order_->addItem(tr("automatic: found out and checked"), static_cast<int>(Flip::Auto));
  order_->addItem(tr("as stored"), static_cast<int>(Flip::None));
  order_->addItem(tr("columns (u) reversed"), static_cast<int>(Flip::U));
  order_->addItem(tr("rows (v) reversed"), static_cast<int>(Flip::V));
  order_->addItem(tr("both reversed"), static_cast<int>(Flip::Both));
  form.addRow(tr("&Order of views"), order_);
}

void ConventionsDialog::addUnits(QFormLayout& form) {
  units_->setObjectName("conventions.units");
  units_->setToolTip(tr("Decides how depth becomes disparity"));
  units_->addItem(tr("automatic: the plausible one"), static_cast<int>(Units::Auto));
  units_->addItem(tr("dH holds the image width"), static_cast<int>(Units::WithWidth));
  units_->addItem(tr("dH lacks the image width"), static_cast<int>(Units::WithoutWidth));
  form.addRow(tr("Depth &units"), units_);
}

void ConventionsDialog::addNames(QFormLayout& form) {
  pattern_->setObjectName("conventions.pattern");
  pattern_->setPlaceholderText(tr("automatic"));
  pattern_->setToolTip(tr(
      "File name with {row} and {col}, or {index}; * stands for anything: view_{row}_{col}.png"));
  form.addRow(tr("Image &names"), pattern_);
  snake_->setObjectName("conventions.snake");
  form.addRow(tr("&Snake"), snake_);
}

void ConventionsDialog::display(const io::OpenOptions& conventions) {
  order_->setCurrentIndex(order_->findData(static_cast<int>(conventions.flip)));
  units_->setCurrentIndex(units_->findData(static_cast<int>(conventions.units)));
  pattern_->setText(QString::fromStdString(conventions.pattern));
  snake_->setChecked(conventions.snake);
}

io::OpenOptions ConventionsDialog::conventions() const {
  io::OpenOptions chosen;
  chosen.flip = static_cast<Flip>(order_->currentData().toInt());
  chosen.units = static_cast<Units>(units_->currentData().toInt());
  chosen.pattern = pattern_->text().trimmed().toStdString();
  chosen.snake = snake_->isChecked();
  return chosen;
}

}  // namespace episcope
