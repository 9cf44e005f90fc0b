// SPDX-License-Identifier: Apache-2.0
import theme from 'vitepress/theme-without-fonts';
import BeforeAfter from './BeforeAfter.vue';
import './style.css';

export default { extends: theme, enhanceApp: ({ app }) => app.component('BeforeAfter', BeforeAfter) };
