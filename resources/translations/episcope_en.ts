<?xml version="1.0" encoding="utf-8"?>
<!DOCTYPE TS>
<TS version="2.1" language="en" sourcelanguage="en">
<context>
    <name>episcope::ImportLabelsDialog</name>
    <message numerus="yes">
        <source>%n view(s) with labels. View %1: %2</source>
        <translation>
            <numerusform>%n view with labels. View %1: %2</numerusform>
            <numerusform>%n views with labels. View %1: %2</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>episcope::MeasureController</name>
    <message numerus="yes">
        <source>%n measured line(s) copied as CSV.</source>
        <translation>
            <numerusform>%n measured line copied as CSV.</numerusform>
            <numerusform>%n measured lines copied as CSV.</numerusform>
        </translation>
    </message>
</context>
</TS>
