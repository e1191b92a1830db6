import excavator from '@dbc/excavator.dbc?raw';
document.body.append(excavator.slice(0, 20));
