// SPDX-License-Identifier: BSD-3-Clause
#include "widgets/capture/capture_objects.h"

#include "widgets/controls/elided_label.h"
#include "widgets/style/theme.h"

#include <QComboBox>
#include <QGridLayout>
#include <QLineEdit>
#include <QPushButton>

namespace episcope {
namespace {

QPushButton* make_button(QWidget* parent, const char* name, const QString& text,
                         const QString& tip) {
  auto* button = new QPushButton(text, parent);
  button->setObjectName(name);
  button->setToolTip(tip);
  return button;
}

}  // namespace

CaptureObjects::CaptureObjects(QWidget* parent)
    : QWidget(parent),
      names_(new QComboBox(this)),
      remove_(make_button(this, "capture.removeObject", tr("Remove"),
                          tr("Removes this object with its pairs"))),
      mesh_(new ElidedLabel(this, Qt::ElideMiddle)) {
  names_->setObjectName("capture.objects");
  names_->setAccessibleName(tr("Objects"));
  names_->setToolTip(
      tr("The object whose pairs are picked; type to rename it. Each has its own mesh and pose."));
  names_->setEditable(true);
  names_->setInsertPolicy(QComboBox::NoInsert);
  names_->setCompleter(nullptr);
  names_->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
  names_->setMinimumContentsLength(6);
  mesh_->setObjectName("capture.mesh");
  auto* add = make_button(this, "capture.addObject", tr("Add…"),
                          tr("Adds one more object, with a mesh of its own"));
  auto* open = make_button(this, "capture.open", tr("Open mesh…"),
                           tr("A scan of what the light field shows: PLY, OBJ or STL"));
  auto* layout = new QGridLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setVerticalSpacing(theme::kSpacing / 2);
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

void CaptureObjects::setMesh(const QString& text) {
  mesh_->setFullText(text.isEmpty() ? tr("No mesh") : text);
}

}  // namespace episcope

#include "moc_capture_objects.cpp"
