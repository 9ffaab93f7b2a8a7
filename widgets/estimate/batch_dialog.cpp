// SPDX-License-Identifier: BSD-3-Clause
#include "widgets/estimate/batch_dialog.h"

#include <QDialogButtonBox>
#include <QGridLayout>
#include <QLabel>
#include <QListWidget>
#include <QPushButton>

namespace episcope {
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
  auto* answer = new QDialogButtonBox(QDialogButtonBox::Cancel, this);
  run_ = answer->addButton(QString(), QDialogButtonBox::AcceptRole);
  run_->setObjectName("batch.run");
  layout->addWidget(answer, 2, 0, 1, 2);
  connect(answer, &QDialogButtonBox::accepted, this, &QDialog::accept);
  connect(answer, &QDialogButtonBox::rejected, this, &QDialog::reject);
  resize(kSize);
  showCount();
}

QListWidget* BatchDialog::addList(const QString& name, const QString& title,
                                  const std::vector<Row>& rows) {
  auto* list = new QListWidget(this);
  list->setObjectName(name);
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

#include "moc_batch_dialog.cpp"
